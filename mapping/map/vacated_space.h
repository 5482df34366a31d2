// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

// Space that moved or deleted objects occupied (MapSnapshot::vacated); left_space.h defines the voxels.

/// Records the old place of an object that is about to leave. No effect unless the object is where it was seen: an edit
/// may have placed it (SubmapInfo::is_placed), or its voxels are not on the map's grid.
void NoteVacated(const Submap& leaving, Map& map);

/// Reverts NoteVacated for an object that has come back. Same cost.
void TakeVacatedBack(const Submap& back, Map& map);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

// Where objects were that an edit has moved or deleted (MapSnapshot::vacated): what they left is that of left_space.h.

/// Notes in the map's layer what an object is about to leave. Nothing, if it is not where it was seen: somebody has put
/// it there (SubmapInfo::is_placed), or its voxels are not the map's.
void NoteVacated(const Submap& leaving, Map& map);

/// Of an object of the map that has come back: what it would leave now is not vacated any longer. Costs the same.
void TakeVacatedBack(const Submap& back, Map& map);

}  // namespace dhpmap

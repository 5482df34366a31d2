// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

/// Notes in the map's layer what an object is about to leave (MapSnapshot::vacated), before an edit moves or deletes
/// it: voxels that it observed, and for a thing also those in the box around its surface that nobody has seen and that
/// are reached from behind its surface through nothing but such voxels, so its inside. What was looked through, or what
/// another object shows, is left out. Nothing, if it is not where it was seen: somebody has put it there
/// (SubmapInfo::is_placed), or its voxels are not the map's.
/// Costs in proportion to the object's blocks and, for a thing, to the blocks of its box that nobody has seen; no
/// inside of boxes above 2 million voxels.
void NoteVacated(const Submap& leaving, Map& map);

/// Of an object of the map that has come back: what it would leave now is not vacated any longer. Costs the same.
void TakeVacatedBack(const Submap& back, Map& map);

}  // namespace dhpmap

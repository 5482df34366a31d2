// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "mapping/map/map.h"

namespace dhpmap {

// What an object leaves where it was seen, once an edit has moved or deleted it (MapSnapshot::vacated): voxels that it
// observed, and for a thing also those in the box around its surface that nobody has seen and that are reached from
// behind its surface through nothing but such voxels, so its inside. What was looked through, or what another object
// shows, is left out. To work it out costs in proportion to the object's blocks and, for a thing, to the blocks of its
// box that nobody has seen; no inside of boxes above 2 million voxels.

/// Notes in the map's layer what an object is about to leave. Nothing, if it is not where it was seen: somebody has put
/// it there (SubmapInfo::is_placed), or its voxels are not the map's.
void NoteVacated(const Submap& leaving, Map& map);

/// Of an object of the map that has come back: what it would leave now is not vacated any longer. Costs the same.
void TakeVacatedBack(const Submap& back, Map& map);

/// A state that an object has just been moved in, whatever its pose is now.
struct MovedAway {
  const Submap& moved;
  const std::vector<std::shared_ptr<const Submap>>& submaps;
  const MapConfig& config;
  const FreeSpace& free_space;
};
/// The vacated space with what the object has left, which NoteVacated would have noted before it was moved. If some of
/// that cannot be read (BlockTile), nothing is added: the place is one that nobody knows.
std::shared_ptr<const FreeSpace> WithLeft(const MovedAway& state, const std::shared_ptr<const FreeSpace>& vacated);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "mapping/free/free_space.h"
#include "mapping/map/map_config.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

// What an object leaves where it was seen, once an edit has moved or deleted it (MapSnapshot::vacated): voxels that it
// observed, and for a thing also those in the box around its surface that nobody has seen and that are reached from
// behind its surface through nothing but such voxels, so its inside. What was looked through, or what another object
// shows, is left out. To work it out costs in proportion to the object's blocks and, for a thing, to the blocks of its
// box that nobody has seen; no inside of boxes above 2 million voxels.

/// A state that an object is about to be moved in, or has just been moved in, whatever its pose is now.
struct MovedAway {
  const Submap& moved;
  const std::vector<std::shared_ptr<const Submap>>& submaps;
  const MapConfig& config;
  const FreeSpace& free_space;
};
/// Adds what the object leaves to a layer of vacated space. Throws StatusError if some of it cannot be read
/// (BlockTile).
void AddLeft(const MovedAway& state, FreeSpace& vacated);
/// Takes it out of one, as the object is back. Likewise.
void TakeLeft(const MovedAway& state, FreeSpace& vacated);

/// The vacated space with what the object has left, which NoteVacated would have noted before it was moved. If some of
/// that cannot be read (BlockTile), nothing is added: the place is one that nobody knows.
std::shared_ptr<const FreeSpace> WithLeft(const MovedAway& state, const std::shared_ptr<const FreeSpace>& vacated);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "mapping/free/free_space.h"
#include "mapping/map/map_config.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

// The space that an object leaves when an edit moves or deletes it (MapSnapshot::vacated): its observed voxels, and for
// a thing also its inside. The inside consists of the unseen voxels in the box around its surface that are reached from
// behind the surface through such voxels only. Voxels that sensors have looked through, or that another object shows,
// are left out. The cost is linear in the object's blocks and, for a thing, in the unseen blocks of its box. Boxes
// above 2 million voxels have no inside.

/// A state in which an object is about to be moved, or has just been moved. Its present pose does not matter.
struct MovedAway {
  const Submap& moved;
  const std::vector<std::shared_ptr<const Submap>>& submaps;
  const MapConfig& config;
  const FreeSpace& free_space;
};
/// Adds the object's space to a layer of vacated space. Throws StatusError if some of it cannot be read (BlockTile).
void AddLeft(const MovedAway& state, FreeSpace& vacated);
/// Removes it from the layer when the object is back. Throws likewise.
void TakeLeft(const MovedAway& state, FreeSpace& vacated);

/// The vacated space including the object's space, as NoteVacated would have recorded it before the move. If some of it
/// cannot be read (BlockTile), nothing is added: the place is unknown.
std::shared_ptr<const FreeSpace> WithLeft(const MovedAway& state, const std::shared_ptr<const FreeSpace>& vacated);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/refinement/voxel_merge.h"

namespace dhpmap {

/// One submap's block at a position whose voxels change hands.
struct Holder {
  SubmapId id;
  BlockEntry before;                ///< without geometry: the submap had no block here
  std::shared_ptr<TsdfBlock> tsdf;  ///< what it has afterwards; null while nothing changed, and where nothing is left
  std::shared_ptr<LabelBlock> labels;
  std::shared_ptr<GoneBlock> gone;  ///< null: as before
  bool is_emptied = false;

  /// What is contradicted stays with its submap, and has no say.
  [[nodiscard]] bool Holds(int linear) const { return before.tsdf != nullptr && before.Shows(linear); }
};

/// The submaps that hold a block at one index, by ascending id. A voxel is written at most once.
struct Position {
  BlockIndex index;
  std::vector<Holder> holders;
  std::int64_t num_shared = 0, num_moved = 0;

  /// That of a submap, which may have had no block here yet. Invalidates references to holders.
  Holder& HolderOf(SubmapId id);
  /// What `merged` says of a voxel becomes that of the winner, whatever it held there.
  void Give(int linear, const MergedVoxel& merged, SubmapId winner, bool is_concluded);
  /// The holder has the voxel no longer.
  void Take(int linear, Holder& holder);
  /// Afterwards: most of those who lose a voxel have none left in the block.
  void DropEmptyBlocks();
};

/// Puts a position into the map, and lets go of what was there. Adds the submaps that it wrote to.
void PutPosition(Position& position, Map& map, std::vector<SubmapId>& changed);

/// Spheres, classes and confidences of what changed, once all positions are in the map; removes submaps that are left
/// empty and tells how many.
int TidySubmaps(std::vector<SubmapId> changed, Map& map);

}  // namespace dhpmap

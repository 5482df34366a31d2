// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/base/cache_line.h"
#include "mapping/base/refinement_scratch.h"
#include "mapping/evidence/voxel_merge.h"
#include "mapping/map/map.h"

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
struct alignas(kCacheLineBytes) Position {
  BlockIndex index;
  ScratchVector<Holder> holders;
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

/// Positions that are settled before they are put into the map: what is written is never all in memory twice.
inline constexpr std::size_t kPositionsAtOnce = 512;

/// Puts a position into the map, and lets go of what was there. Adds the submaps that it wrote to.
void PutPosition(Position& position, Map& map, std::vector<SubmapId>& changed);

/// Spheres, classes and confidences of what changed, once all positions are in the map; removes submaps that are left
/// empty and tells how many.
int TidySubmaps(std::vector<SubmapId> changed, Map& map);

}  // namespace dhpmap

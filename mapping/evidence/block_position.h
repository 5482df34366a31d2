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

/// One submap's block at a position whose voxels are reassigned.
struct Holder {
  SubmapId id;
  BlockEntry before;                ///< without geometry: the submap had no block here
  std::shared_ptr<TsdfBlock> tsdf;  ///< afterwards; null if nothing has changed, or if no voxel is left
  std::shared_ptr<LabelBlock> labels;
  std::shared_ptr<GoneBlock> gone;  ///< null: as before
  bool is_emptied = false;

  /// Whether the submap shows the voxel. Contradicted voxels stay with their submap and do not count.
  [[nodiscard]] bool Holds(int linear) const { return before.tsdf != nullptr && before.Shows(linear); }
};

/// The submaps that hold a block at one index, by ascending id. A voxel is written at most once.
struct alignas(kCacheLineBytes) Position {
  BlockIndex index;
  ScratchVector<Holder> holders;
  std::int64_t num_shared = 0, num_moved = 0;

  /// The holder of a submap; added if the submap had no block here. Invalidates references to holders.
  Holder& HolderOf(SubmapId id);
  /// Replaces the winner's voxel by `merged`.
  void Give(int linear, const MergedVoxel& merged, SubmapId winner, bool is_concluded);
  /// Removes the voxel from the holder.
  void Take(int linear, Holder& holder);
  /// Call at the end: most holders that lose a voxel have none left in the block.
  void DropEmptyBlocks();
};

/// Number of positions that are computed before they are written to the map, so that not all written data are in memory
/// twice.
inline constexpr std::size_t kPositionsAtOnce = 512;

/// Writes a position to the map and releases the earlier blocks. Adds the written submaps to `changed`.
void PutPosition(Position& position, Map& map, std::vector<SubmapId>& changed);

/// Updates spheres, classes and confidences of the changed submaps, once all positions are written. Removes submaps
/// that are empty, and returns their number.
int TidySubmaps(std::vector<SubmapId> changed, Map& map);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// An observed voxel of a submap, not contradicted since (GoneBlock). Valid as long as the submap.
struct VoxelSample {
  const BlockEntry* block = nullptr;  ///< null: there is no such voxel
  int linear = 0;                     ///< the voxel in its block

  [[nodiscard]] bool IsObserved() const { return block != nullptr; }
  // Of an observed one:
  [[nodiscard]] float distance_m() const { return block->tsdf->distance_m[static_cast<std::size_t>(linear)]; }
  [[nodiscard]] float weight() const { return block->tsdf->weight[static_cast<std::size_t>(linear)]; }
  [[nodiscard]] Color color() const { return block->tsdf->color[static_cast<std::size_t>(linear)]; }
};

/// A voxel of a block; see LinearIndex.
inline VoxelSample SampleVoxel(const BlockEntry& block, int linear) {
  const bool is_shown = block.tsdf != nullptr && block.Shows(linear);
  return is_shown ? VoxelSample{&block, linear} : VoxelSample{};
}

/// The voxel of `submap` at an index of its own grid, or the one that contains a point of its frame (finite, metres,
/// within the range of the grid).
inline VoxelSample SampleVoxel(const Submap& submap, VoxelIndex voxel) {
  const BlockEntry* block = submap.blocks().Find(BlockOf(voxel));
  return block != nullptr ? SampleVoxel(*block, LinearIndex(voxel)) : VoxelSample{};
}
inline VoxelSample SampleVoxelAt(const Submap& submap, const Eigen::Vector3d& p_submap) {
  return SampleVoxel(submap, VoxelAt(p_submap, submap.info().voxel_size_m));
}

}  // namespace dhpmap

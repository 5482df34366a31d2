// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/voxel_sampler.h"

namespace dhpmap {

VoxelSample SampleVoxel(const BlockEntry& block, int linear) {
  const bool is_shown = block.tsdf != nullptr && block.Shows(linear);
  return is_shown ? VoxelSample{&block, linear} : VoxelSample{};
}

VoxelSample SampleVoxel(const Submap& submap, VoxelIndex voxel) {
  const BlockEntry* block = submap.blocks().Find(BlockOf(voxel));
  return block != nullptr ? SampleVoxel(*block, LinearIndex(voxel)) : VoxelSample{};
}

VoxelSample SampleVoxelAt(const Submap& submap, const Eigen::Vector3d& p_submap) {
  return SampleVoxel(submap, VoxelAt(p_submap, submap.info().voxel_size_m));
}

}  // namespace dhpmap

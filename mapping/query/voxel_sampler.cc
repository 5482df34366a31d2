// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/voxel_sampler.h"

namespace dhpmap {

VoxelSample SampleVoxel(const Submap& submap, VoxelIndex voxel) {
  const BlockEntry* block = submap.blocks().Find(BlockOf(voxel));
  if (block == nullptr || block->tsdf == nullptr) return {};
  const int linear = LinearIndex(voxel);
  return block->tsdf->IsObserved(linear) ? VoxelSample{block, linear} : VoxelSample{};
}

VoxelSample SampleVoxelAt(const Submap& submap, const Eigen::Vector3d& p_submap) {
  return SampleVoxel(submap, VoxelAt(p_submap, submap.info().voxel_size_m));
}

}  // namespace dhpmap

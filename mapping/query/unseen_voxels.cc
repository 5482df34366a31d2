// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/unseen_voxels.h"

namespace dhpmap {

bool IsAllowed(const QueryWorld& world, VoxelIndex voxel, double max_depth_m, WorkBudget* work) {
  constexpr std::int64_t kInsideWork = 64;
  return world.has_touchable() && SpendOf(work, kInsideWork) && world.IsInTouchable(voxel, max_depth_m);
}

bool IsFreeThroughout(const QueryWorld& world, const Eigen::AlignedBox3d& box) {
  if (!world.IsInReach(box.min()) || !world.IsInReach(box.max())) return false;
  const BlockIndex from = BlockOf(VoxelAt(box.min(), world.voxel_size_m()));
  const BlockIndex to = BlockOf(VoxelAt(box.max(), world.voxel_size_m()));
  constexpr double kMostBlocks = 512;
  if ((to.x - from.x + 1.0) * (to.y - from.y + 1.0) * (to.z - from.z + 1.0) > kMostBlocks) return false;
  for (std::int32_t z = from.z; z <= to.z; ++z) {
    for (std::int32_t y = from.y; y <= to.y; ++y) {
      for (std::int32_t x = from.x; x <= to.x; ++x) {
        const BlockIndex block{x, y, z};
        const FreeTile* tile = world.FindFreeTile(TileOf(block));
        if (tile == nullptr || (tile->full() >> CellOf(block) & 1u) == 0) return false;
      }
    }
  }
  return true;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/nearest_voxels.h"

#include <cmath>

namespace dhpmap {
namespace {

/// The block that was asked about last: points follow each other in the image, and so in space.
class BlockFinder {
 public:
  explicit BlockFinder(const BlockTable& blocks) : blocks_(blocks) {}
  const BlockEntry* Find(BlockIndex index) {
    if (index != last_ || !has_last_) {
      entry_ = blocks_.Find(index);
      last_ = index;
      has_last_ = true;
    }
    return entry_;
  }

 private:
  const BlockTable& blocks_;
  BlockIndex last_;
  bool has_last_ = false;
  const BlockEntry* entry_ = nullptr;
};

/// How the TSDF changes from a voxel to the one before or behind it in its block, for one voxel along an axis.
float SlopeIn(const BlockEntry& block, int linear, int axis) {
  const int step = 1 << (axis * kBlockSideLog2);
  const int place = (linear >> (axis * kBlockSideLog2)) & (kBlockSide - 1);
  const int other = place + 1 < kBlockSide ? linear + step : linear - step;
  if (!block.Shows(other)) return 0;
  const float change_m = block.tsdf->distance_m[static_cast<std::size_t>(other)] -
                         block.tsdf->distance_m[static_cast<std::size_t>(linear)];
  return other > linear ? change_m : -change_m;
}

/// Where the submap has a nearer surface, that is taken.
void TakeNearer(const Submap& submap, std::span<const Eigen::Vector3d> points_map_m, std::span<NearestVoxel> nearest) {
  const SubmapInfo& info = submap.info();
  const BoundingSphere sphere = submap.BoundingSphereInMap();
  const Transform T_submap_map = info.T_map_submap.inverse();
  const bool is_moved = !IsIdentity(info.T_map_submap);
  BlockFinder blocks(submap.blocks());
  for (std::size_t i = 0; i < points_map_m.size(); ++i) {
    if (!sphere.Contains(points_map_m[i])) continue;
    const Eigen::Vector3d p_vox = (is_moved ? T_submap_map * points_map_m[i] : points_map_m[i]) / info.voxel_size_m;
    const VoxelIndex voxel = VoxelAt(p_vox, 1);
    const BlockEntry* const block = blocks.Find(BlockOf(voxel));
    const int linear = LinearIndex(voxel);
    if (block == nullptr || block->tsdf == nullptr || !block->Shows(linear)) continue;
    const float distance_m = std::abs(block->tsdf->distance_m[static_cast<std::size_t>(linear)]);
    if (distance_m >= nearest[i].centre_distance_m) continue;
    nearest[i] = {distance_m, block, linear, (p_vox - VoxelCentre(voxel, 1)).cast<float>()};
  }
}

BoundingSphere SphereAround(std::span<const Eigen::Vector3d> points_m) {
  if (points_m.empty()) return {};
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points_m) box.extend(p);
  return {.center_m = box.center(), .radius_m = 0.5 * box.diagonal().norm()};
}

}  // namespace

float NearestVoxel::DistanceOfPoint() const {
  float distance_m = block->tsdf->distance_m[static_cast<std::size_t>(linear)];
  for (int axis = 0; axis < 3; ++axis) distance_m += off_vox[axis] * SlopeIn(*block, linear, axis);
  return distance_m;
}

std::vector<NearestVoxel> FindNearestVoxels(std::span<const Eigen::Vector3d> points_map_m, const Map& map) {
  const BoundingSphere all = SphereAround(points_map_m);
  std::vector<NearestVoxel> nearest(points_map_m.size());
  for (const auto& submap : map.submaps()) {
    if (submap->IsAbsent() || !submap->BoundingSphereInMap().Intersects(all)) continue;
    TakeNearer(*submap, points_map_m, nearest);
  }
  return nearest;
}

}  // namespace dhpmap

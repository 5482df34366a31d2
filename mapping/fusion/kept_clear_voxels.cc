// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/kept_clear_voxels.h"

#include <algorithm>
#include <cmath>

namespace dhpmap {
namespace {

Eigen::Vector3d CentreOf(BlockIndex block, double voxel_size_m) {
  return BlockCorner(block, voxel_size_m).array() + 0.5 * kBlockSide * voxel_size_m;
}

}  // namespace

bool KeptClearVoxels::MayBeAround(BlockIndex block) const {
  const Eigen::Vector3d center_map_m = T_map_submap_ * CentreOf(block, voxel_size_m_);
  const double radius_m = 1.5 * std::sqrt(3.0) * kBlockSide * voxel_size_m_;
  const auto& regions = kept_clear_.list();
  return std::any_of(regions.begin(), regions.end(),
                     [&](const KeptClearRegion& region) { return Touches(region.region, center_map_m, radius_m); });
}

const VoxelMask* KeptClearVoxels::In(BlockIndex block) {
  const auto [at, is_new] = masks_.try_emplace(block);
  VoxelMask& mask = at->second;
  if (is_new) {
    const Eigen::Vector3d center_map_m = T_map_submap_ * CentreOf(block, voxel_size_m_);
    const double radius_m = 0.5 * std::sqrt(3.0) * kBlockSide * voxel_size_m_;
    for (const KeptClearRegion& region : kept_clear_.list()) {
      if (!Touches(region.region, center_map_m, radius_m)) continue;
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (Contains(region.region, T_map_submap_ * VoxelCentre(VoxelIn(block, i), voxel_size_m_))) {
          SetIn(mask, i, true);
        }
      }
    }
  }
  return HasNone(mask) ? nullptr : &mask;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

#include "mapping/submap/submap.h"

namespace dhpmap::testing {

using DistanceFunction = std::function<double(const Eigen::Vector3d&)>;

constexpr double kVoxel_m = 0.05;
/// A ball off the grid, of 11 voxels: over block borders on all sides.
inline const Eigen::Vector3d kBallCenter_m(0.013, -0.021, 0.007);
inline constexpr double kBallRadius_m = 0.55;

inline SubmapInfo SolidInfo() {
  SubmapInfo info;
  info.id = SubmapId(7);
  info.panoptic = Panoptic::kThing;
  info.class_id = ClassId(2);
  info.voxel_size_m = kVoxel_m;
  info.truncation_m = 3 * kVoxel_m;
  return info;
}

/// All blocks from `low` to `high` filled with a truncated distance field; `seed` shuffles the order of allocation.
inline Submap SolidSubmap(const DistanceFunction& distance, BlockIndex low, BlockIndex high, unsigned seed = 0) {
  std::vector<BlockIndex> indices;
  for (int z = low.z; z <= high.z; ++z) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) indices.push_back({x, y, z});
    }
  }
  std::shuffle(indices.begin(), indices.end(), std::mt19937(seed));
  Submap submap(SolidInfo(), 1);
  for (const BlockIndex index : indices) {
    TsdfBlock& block = submap.MutableTsdf(index);
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      const double d = distance(VoxelCentre(VoxelIn(index, linear), kVoxel_m));
      block.distance_m[linear] = static_cast<float>(std::clamp(d, -3 * kVoxel_m, 3 * kVoxel_m));
      block.weight[linear] = 1.0f;
    }
  }
  return submap;
}

inline DistanceFunction Sphere(const Eigen::Vector3d& center_m, double radius_m) {
  return [=](const Eigen::Vector3d& p) { return (p - center_m).norm() - radius_m; };
}

}  // namespace dhpmap::testing

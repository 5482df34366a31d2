// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace dhpmap {

/// No voxel farther from the sensor than this counts as free, whatever the range limit. Bounds the cost of a frame.
inline constexpr int kMaxSight_vox = 512;

/// Options for looking through a frame.
struct LookOptions {
  double voxel_size_m = 0;
  double margin_m = 0;     ///< length before a return that does not count as free
  double max_range_m = 0;  ///< no voxel beyond counts as free
};

/// In voxels from the sensor, along the axes of the map's grid. Empty if `least` exceeds `most` along an axis.
struct Box {
  Eigen::Vector3d least_vox = Eigen::Vector3d::Ones(), most_vox = -Eigen::Vector3d::Ones();

  [[nodiscard]] Box GrownBy(double by_vox) const {
    if (!(least_vox.array() <= most_vox.array()).any()) return *this;
    return {least_vox - Eigen::Vector3d::Constant(by_vox), most_vox + Eigen::Vector3d::Constant(by_vox)};
  }
};

}  // namespace dhpmap

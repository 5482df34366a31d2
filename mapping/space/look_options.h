// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace dhpmap {

/// No voxel farther from the sensor than this is called free, whatever the range limit: bounds what a frame may cost.
inline constexpr int kMaxSight_vox = 512;

/// How a frame is looked through.
struct LookOptions {
  double voxel_size_m = 0;
  double margin_m = 0;     ///< before a return that is not called free
  double max_range_m = 0;  ///< no farther
};

/// In voxels from the sensor, along the axes of the map's grid. Empty if `least` is above `most` somewhere.
struct Box {
  Eigen::Vector3d least_vox = Eigen::Vector3d::Ones(), most_vox = -Eigen::Vector3d::Ones();

  [[nodiscard]] Box GrownBy(double by_vox) const {
    if (!(least_vox.array() <= most_vox.array()).any()) return *this;
    return {least_vox - Eigen::Vector3d::Constant(by_vox), most_vox + Eigen::Vector3d::Constant(by_vox)};
  }
};

}  // namespace dhpmap

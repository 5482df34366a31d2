// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace dhpmap {

/// Sphere that encloses all voxels of a submap (paper II-A). A negative radius means empty.
struct BoundingSphere {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  double radius_m = -1.0;

  [[nodiscard]] bool IsEmpty() const { return radius_m < 0; }
  [[nodiscard]] bool Contains(const Eigen::Vector3d& p) const {
    return !IsEmpty() && (p - center_m).squaredNorm() <= radius_m * radius_m;
  }
  [[nodiscard]] bool Intersects(const BoundingSphere& other) const {
    const double reach_m = radius_m + other.radius_m;
    return !IsEmpty() && !other.IsEmpty() && (other.center_m - center_m).squaredNorm() <= reach_m * reach_m;
  }
};

}  // namespace dhpmap

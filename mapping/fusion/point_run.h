// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "mapping/fusion/point_kernel.h"

namespace dhpmap {

/// The sum of points of one segment in one voxel that are close together in the frame.
struct PointRun {
  PointPlace place;
  Eigen::Array4f weighted_m = Eigen::Array4f::Zero();      ///< the weight, and the weighted sum of the points
  Eigen::Array4f weighted_color = Eigen::Array4f::Zero();  ///< red, green, blue, and the number of points

  [[nodiscard]] float weight() const { return weighted_m[0]; }
  [[nodiscard]] Eigen::Vector3f weighted_sum_m() const { return weighted_m.tail<3>(); }
  [[nodiscard]] Eigen::Vector3f color_sum() const { return weighted_color.head<3>(); }
  [[nodiscard]] std::uint32_t num_points() const { return static_cast<std::uint32_t>(weighted_color[3]); }
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "clients/simulator/solid.h"

namespace dhpmap::simulator {

/// Distances to the nearest solid, sampled on a grid and clamped to `kReach_m`: coarse, but about ten times as fast as
/// exact ones. For shading only. Immutable.
class DistanceGrid {
 public:
  static constexpr float kReach_m = 0.5f;
  static constexpr float kCell_m = 0.05f;

  explicit DistanceGrid(std::span<const Solid> solids);
  /// Interpolated; kReach_m outside the grid.
  [[nodiscard]] float At(const Eigen::Vector3f& p_map) const;

 private:
  void Draw(const Solid& solid);
  [[nodiscard]] std::size_t Index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells_.y()) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(cells_.x()) +
           static_cast<std::size_t>(x);
  }

  Eigen::Vector3f origin_m_ = Eigen::Vector3f::Zero();
  Eigen::Vector3i cells_ = Eigen::Vector3i::Zero();
  std::vector<float> distance_m_;
};

}  // namespace dhpmap::simulator

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace dhpmap {

/// Sums over bundles, in metres from the sensor's origin, to which a plane is fitted. In double precision, so that one
/// origin serves all, and sums of neighbouring cubes can be added.
struct PlaneMoments {
  /// Weight and weighted position; xx, yy, zz and the number of bundles; yz, zx, xy.
  alignas(16) std::array<double, 12> sums{};

  [[nodiscard]] double num_bundles() const { return sums[7]; }
  /// Adds a bundle at its mean, from its weighted sum of points.
  void Add(const Eigen::Vector3f& weighted_sum_m, float weight) {
    const double x = weighted_sum_m.x(), y = weighted_sum_m.y(), z = weighted_sum_m.z(), per = 1.0 / weight;
    const double mx = x * per, my = y * per, mz = z * per;
    const std::array<double, 12> one{weight, x, y, z, x * mx, y * my, z * mz, 1, y * mz, z * mx, x * my, 0};
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += one[i];
  }
  void Add(const PlaneMoments& other) {
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += other.sums[i];
  }
};

/// A surface near some bundles.
struct PlaneFit {
  static constexpr double kLeastBundles = 5;  ///< fewer may lie in a plane by chance
  enum class Outcome {
    kPlane,
    kTooFew,  ///< or on a line: a wider window may contain more
    kNotFlat
  };
  Outcome outcome = Outcome::kTooFew;
  Eigen::Vector3f normal;                   ///< unit, of either sign
  Eigen::Vector3f mean_m;                   ///< on the plane
  Eigen::Vector3f squares_m2, products_m2;  ///< covariance: xx, yy, zz and yz, zx, xy

  /// Standard deviation of the bundles along a unit vector.
  [[nodiscard]] float SpreadAlong_m(const Eigen::Vector3f& direction) const;
};

/// The plane through the weighted mean, across the smallest principal axis.
PlaneFit FitPlane(const PlaneMoments& moments, float voxel_size_m);

}  // namespace dhpmap

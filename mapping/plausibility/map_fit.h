// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "mapping/base/transform.h"
#include "mapping/map/map.h"
#include "mapping/plausibility/frame_sample.h"

namespace dhpmap {

/// What a map says of points that somebody claims to have measured.
struct MapFit {
  std::size_t num_points = 0;
  std::size_t num_agreeing = 0;      ///< on a surface
  std::size_t num_contradicted = 0;  ///< beside one, or in space that was looked through
  std::vector<float> residuals_m;    ///< of those in the band of a surface, in no order

  [[nodiscard]] std::size_t num_known() const { return num_agreeing + num_contradicted; }
  /// Of the known ones; 0 if there are none.
  [[nodiscard]] double AgreeingFraction() const { return Share(num_agreeing, num_known()); }
  /// Of all points.
  [[nodiscard]] double KnownFraction() const { return Share(num_known(), num_points); }
};

/// Looks up the points (sensor frame). Each is judged by the surface that is nearest to it; what is neither in the band
/// of one nor free says nothing. Reads the map alone; throws StatusError where tiles of it cannot be read.
MapFit FitToMap(std::span<const Eigen::Vector3f> points_m, const Transform& T_map_sensor, const Map& map);

/// Of the rays to these points, or to some of them, those that a surface of the map should have stopped. Costs many
/// times as much.
double SeenThroughFraction(std::span<const Eigen::Vector3f> points_m, const Transform& T_map_sensor, const Map& map);

}  // namespace dhpmap

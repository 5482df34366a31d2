// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "mapping/base/transform.h"
#include "mapping/map/map.h"
#include "mapping/plausibility/frame_sample.h"

namespace dhpmap {

/// Agreement of measured points with a map.
struct MapFit {
  std::size_t num_points = 0;
  std::size_t num_agreeing = 0;      ///< on a surface
  std::size_t num_contradicted = 0;  ///< in the band but off the surface, or in free space
  std::vector<float> residuals_m;    ///< of the points in the band of a surface, in unspecified order

  [[nodiscard]] std::size_t num_known() const { return num_agreeing + num_contradicted; }
  /// Of the known ones; 0 if there are none.
  [[nodiscard]] double AgreeingFraction() const { return Share(num_agreeing, num_known()); }
  /// Of all points.
  [[nodiscard]] double KnownFraction() const { return Share(num_known(), num_points); }
};

/// Looks up the points (sensor frame). Each is compared with its nearest surface; a point that is neither in the band
/// of a surface nor in free space does not count. Throws StatusError if tiles of the map cannot be read.
MapFit FitToMap(std::span<const Eigen::Vector3f> points_m, const Transform& T_map_sensor, const Map& map);

/// The fraction of the rays to these points, or to some of them, that a surface of the map should have stopped. Costs
/// many times as much.
double SeenThroughFraction(std::span<const Eigen::Vector3f> points_m, const Transform& T_map_sensor, const Map& map);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/geometry/moving_sphere.h"
#include "mapping/query/body_query.h"

namespace dhpmap {

/// The smallest distance of moving spheres from an obstacle's surface.
struct LeastClearance {
  double distance_m;  ///< from a sphere to the surface, minus its padding; negative: penetration depth
  double at = 0;      ///< time, in waypoints
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< on the surface
  const SubmapInfo* submap = nullptr;  ///< owner of the surface; null: none is so near. Valid as long as the surfaces
};

/// The clearance of spheres along a motion: at each moment the distance of the centre to the nearest surface, from
/// either side, minus its padding and the radius. It is smallest when the centre is on the surface: minus radius and
/// padding. Between two knots the curvature of the squared distance is at most that of the distance to a point, so far
/// from surfaces few moments need a distance. Immutable, thread-safe.
class ClearanceQuery {
 public:
  /// The result is at most this much too large.
  static constexpr double kTolerance_m = 1e-4;

  ClearanceQuery(std::shared_ptr<const MapSurfaces> surfaces, const BodyOptions& options);

  /// Replaces `least` if the clearance is smaller, and returns whether it was; a difference below the tolerance may be
  /// ignored. Knots are in the map frame, in order of time, finite. Ends soon after a `stop` request or when `work` is
  /// spent; the result is then invalid.
  bool Lower(std::span<const SphereKnot> knots, LeastClearance& least, const std::stop_token& stop = {},
             WorkBudget* work = nullptr) const;

 private:
  class Search;

  double most_distance_m_;
  std::vector<double> paddings_m_;  ///< distinct values
  SurfacePadding padding_;
  DistanceQuery distances_;
};

}  // namespace dhpmap

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

/// Where moving spheres are nearest to a surface that is in their way.
struct LeastClearance {
  double distance_m;  ///< from a sphere to the surface, less the padding of that; below 0: so far it is within
  double at = 0;      ///< when, in waypoints
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< on the surface
  const SubmapInfo* submap = nullptr;  ///< whose surface; null: none so near. Valid as long as the surfaces
};

/// How near spheres come to surfaces on their way: of each moment the distance of the centre to the nearest surface,
/// from whichever side, less its padding and the radius. No deeper than radius and padding: then the centre is on the
/// surface. Between two knots a squared distance bends no more than that of a point does, so few moments are looked at
/// where surfaces are far. Immutable, thread-safe.
class ClearanceQuery {
 public:
  /// What is found is so much too large at most.
  static constexpr double kTolerance_m = 1e-4;

  ClearanceQuery(std::shared_ptr<const MapSurfaces> surfaces, const BodyOptions& options);

  /// Puts what is nearer than `least` in its place; what is so by less than the tolerance may be left out. Knots are of
  /// the map frame, in the order of time; finite. Gives up soon after `stop` is requested or `work` is over: then what
  /// is there means nothing. True if something was nearer.
  bool Lower(std::span<const SphereKnot> knots, LeastClearance& least, const std::stop_token& stop = {},
             WorkBudget* work = nullptr) const;

 private:
  class Search;

  double most_distance_m_;
  std::vector<double> paddings_m_;  ///< the different ones
  SurfacePadding padding_;
  DistanceQuery distances_;
};

}  // namespace dhpmap

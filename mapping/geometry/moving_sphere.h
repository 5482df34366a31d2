// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "mapping/base/transform.h"
#include "mapping/geometry/triangle_tree.h"

namespace dhpmap {

/// A sphere at a time, in waypoints. Between two knots, centre and radius change linearly.
struct SphereKnot {
  double at;
  Eigen::Vector3d center_m;
  double radius_m;
};

/// A sphere from one knot to the next, in the frame of a triangle; fractions run from 0 to 1.
struct SphereStep {
  Eigen::Vector3d center_m, way_m;
  double radius_m, growth_m;

  [[nodiscard]] Eigen::Vector3d CenterAt(double share) const { return center_m + share * way_m; }
};

/// The fraction at which the sphere first touches a triangle (possibly a point); nothing if it does not. Never too
/// late, and early by a few micrometres at most.
std::optional<double> TimeOfTouch(const SphereStep& step, const TriangleCorners& triangle);
std::optional<double> TimeOfTouch(const SphereStep& step, const Eigen::Vector3d& point);

/// A rigid motion through waypoints: constant velocity, turning about one axis, between consecutive ones.
class RigidPath {
 public:
  /// For points within `reach_m` of the origin of the moving frame. Subdivided so that straight segments are usually
  /// within a millimetre of the true paths.
  RigidPath(std::span<const Transform> waypoints, double reach_m);

  /// A sphere carried along, grown by the error of the straight segments.
  [[nodiscard]] std::vector<SphereKnot> Carried(const Eigen::Vector3d& center_m, double radius_m) const;

 private:
  struct Cut {
    double at;
    Transform T;
  };
  std::vector<Cut> cuts_;
  double margin_m_ = 0;
};

}  // namespace dhpmap

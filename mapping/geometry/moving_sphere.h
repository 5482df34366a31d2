// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "mapping/base/transform.h"
#include "mapping/geometry/triangle_tree.h"

namespace dhpmap {

/// Where a sphere is at a time, which counts waypoints. Between two of them centre and radius change evenly.
struct SphereKnot {
  double at;
  Eigen::Vector3d center_m;
  double radius_m;
};

/// A sphere from one knot to the next, in the frame of a triangle; the share of the way goes from 0 to 1.
struct SphereStep {
  Eigen::Vector3d center_m, way_m;
  double radius_m, growth_m;

  [[nodiscard]] Eigen::Vector3d CenterAt(double share) const { return center_m + share * way_m; }
};

/// The share of the way after which the sphere first touches a triangle (which may be a point); nothing: it does not.
/// Never later than it does, and no more than a few micrometres before.
std::optional<double> TimeOfTouch(const SphereStep& step, const TriangleCorners& triangle);
std::optional<double> TimeOfTouch(const SphereStep& step, const Eigen::Vector3d& point);

/// A rigid motion through waypoints: evenly, turning about one axis, from each to the next.
class RigidPath {
 public:
  /// For what is no farther than `reach_m` from the origin of the moving frame. Cut so finely that straight lines
  /// between the cuts are no farther than a millimetre from where its points go, as a rule.
  RigidPath(std::span<const Transform> waypoints, double reach_m);

  /// A sphere that rides along, grown by what straight lines leave out.
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

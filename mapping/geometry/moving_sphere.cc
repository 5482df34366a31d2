// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/moving_sphere.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dhpmap {
namespace {

/// The distance to a convex shape is convex along the motion, so Newton's steps from before the first contact never
/// pass it, and once the distance stops decreasing, it never decreases again.
template <typename NearestPoint>
std::optional<double> FirstTouch(const SphereStep& step, const NearestPoint& nearest_to) {
  constexpr double kTouch_m = 2e-6;  // single precision of the triangles
  constexpr int kMostSteps = 64;     // at grazing contact a step halves the gap
  double share = 0;
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Vector3d center = step.CenterAt(share);
    const Eigen::Vector3d away = center - nearest_to(center);
    const double distance_m = away.norm(), gap_m = distance_m - step.radius_m - share * step.growth_m;
    if (std::isnan(gap_m)) return std::nullopt;  // a degenerate triangle
    if (gap_m <= kTouch_m) return share;
    const double slope = away.dot(step.way_m) / distance_m - step.growth_m;
    if (slope >= 0) return std::nullopt;
    share += gap_m / -slope;
    if (share > 1) return std::nullopt;
  }
  return share;
}

}  // namespace

std::optional<double> TimeOfTouch(const SphereStep& step, const TriangleCorners& triangle) {
  return FirstTouch(step, [&](const Eigen::Vector3d& center) -> Eigen::Vector3d {
    return NearestPointOf(triangle, center.cast<float>()).cast<double>();
  });
}

std::optional<double> TimeOfTouch(const SphereStep& step, const Eigen::Vector3d& point) {
  return FirstTouch(step, [&](const Eigen::Vector3d&) { return point; });
}

RigidPath::RigidPath(std::span<const Transform> waypoints, double reach_m) {
  constexpr double kFine_m = 1e-3;
  constexpr double kMostCuts = 32;
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const Eigen::Quaterniond from(waypoints[i].linear()), to(waypoints[i + 1].linear());
    const Eigen::Vector3d start = waypoints[i].translation(), way = waypoints[i + 1].translation() - start;
    const double turn_rad = from.angularDistance(to);
    // The distance of an arc of angle a from its chord is r (1 - cos(a / 2)), less than r a^2 / 8.
    const double num_cuts = std::clamp(std::ceil(turn_rad * std::sqrt(reach_m / (8 * kFine_m))), 1.0, kMostCuts);
    margin_m_ = std::max(margin_m_, reach_m * (1 - std::cos(turn_rad / num_cuts / 2)));
    for (double cut = 0; cut < num_cuts; ++cut) {
      const double share = cut / num_cuts;
      Transform T = Transform::Identity();
      T.translate(start + share * way);
      T.rotate(cut == 0 ? from : from.slerp(share, to));
      cuts_.push_back({static_cast<double>(i) + share, T});
    }
  }
  if (!waypoints.empty()) cuts_.push_back({static_cast<double>(waypoints.size() - 1), waypoints.back()});
}

std::vector<SphereKnot> RigidPath::Carried(const Eigen::Vector3d& center_m, double radius_m) const {
  std::vector<SphereKnot> knots;
  knots.reserve(cuts_.size());
  for (const Cut& cut : cuts_) knots.push_back({cut.at, cut.T * center_m, radius_m + margin_m_});
  return knots;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/surface_rays.h"

#include <algorithm>

namespace dhpmap::simulator {
namespace {

/// Rays start far enough outside, and far enough inside a box, that rounding does not matter.
constexpr double kOutside_m = 0.01, kRim_m = 1e-4;

/// Coordinates from one side to the other, both included, in equal steps of at most `step_m`.
std::vector<double> Steps(double min_m, double max_m, double step_m) {
  const double inner_m = std::max(max_m - min_m - 2 * kRim_m, 0.0);
  const int num_steps = static_cast<int>(inner_m / step_m) + 1;
  std::vector<double> at;
  at.reserve(static_cast<std::size_t>(num_steps) + 1);
  for (int i = 0; i <= num_steps; ++i) at.push_back(min_m + kRim_m + inner_m * i / num_steps);
  return at;
}

void AppendPointsOn(const Solid& solid, double step_m, std::vector<Eigen::Vector3d>& points) {
  const Eigen::AlignedBox3d box = solid.Bounds();
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double way_m = box.sizes()[axis] + 2 * kOutside_m;
    for (const double at_u : Steps(box.min()[u], box.max()[u], step_m)) {
      for (const double at_v : Steps(box.min()[v], box.max()[v], step_m)) {
        for (const double side : {-1.0, 1.0}) {
          Ray ray{Eigen::Vector3d::Zero(), -side * Eigen::Vector3d::Unit(axis)};
          ray.origin_m[u] = at_u;
          ray.origin_m[v] = at_v;
          ray.origin_m[axis] = side < 0 ? box.min()[axis] - kOutside_m : box.max()[axis] + kOutside_m;
          if (const auto t = solid.Intersect(ray, way_m)) points.push_back(ray.At(*t));
        }
      }
    }
  }
}

}  // namespace

std::optional<SolidHit> FirstOf(std::span<const Solid* const> solids, const Ray& ray, double max_m) {
  std::optional<SolidHit> first;
  for (const Solid* solid : solids) {
    const auto t = solid->Intersect(ray, first ? first->distance_m : max_m);
    if (t) first = SolidHit{*t, solid};
  }
  return first;
}

double DistanceTo(std::span<const Solid* const> solids, const Eigen::Vector3d& p) {
  double least_m = kFar_m;
  for (const Solid* solid : solids) least_m = std::min(least_m, solid->Distance(p));
  return least_m;
}

Eigen::AlignedBox3d BoundsOf(std::span<const Solid* const> solids) {
  Eigen::AlignedBox3d bounds;
  for (const Solid* solid : solids) bounds.extend(solid->Bounds());
  return bounds;
}

std::vector<Eigen::Vector3d> PointsOn(std::span<const Solid* const> solids, double step_m) {
  std::vector<Eigen::Vector3d> points;
  for (const Solid* solid : solids) AppendPointsOn(*solid, step_m, points);
  return points;
}

}  // namespace dhpmap::simulator

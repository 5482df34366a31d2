// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/distance_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mapping/query/point_order.h"

namespace dhpmap {

/// What is nearest of all that is grown, each by its own.
class DistanceQuery::Searches {
 public:
  explicit Searches(const QueryWorld& world) {
    for (const QueryWorld::Grown& grown : world.grown()) {
      parts_.push_back({grown.padding_m, NearestSearch(world.surfaces(), grown.is_held)});
    }
  }

  struct Found {
    NearestSurface surface;
    double padding_m = 0;
    double reach_m = 0;  ///< to the surface, from whichever side, less its padding
  };
  Found Find(const Eigen::Vector3d& p_map, double limit_m) {
    Found best{.reach_m = limit_m};
    for (auto& [padding_m, search] : parts_) {
      const double within_m = best.reach_m + padding_m;
      if (within_m < 0) continue;
      const NearestSurface found = search.Find(p_map, within_m);
      const double reach_m = (found.p_submap - found.point_submap).norm() - padding_m;
      if (found.is_any && (!best.surface.is_any || reach_m < best.reach_m)) best = {found, padding_m, reach_m};
    }
    return best;
  }

 private:
  struct Part {
    double padding_m;
    NearestSearch search;
  };
  std::vector<Part> parts_;
};

DistanceQuery::DistanceQuery(std::shared_ptr<const MapSurfaces> surfaces, DistanceOptions options)
    : world_(std::move(surfaces), options.scope), options_(std::move(options)) {}

SurfaceDistance DistanceQuery::Within(const Eigen::Vector3d& p_map, double limit_m) const {
  const Searches::Found found = Searches(world_).Find(p_map, limit_m);
  return Describe(p_map, limit_m, found.surface, found.padding_m);
}

void DistanceQuery::At(std::span<const Eigen::Vector3d> points_m, std::span<SurfaceDistance> answers) const {
  // What is nearest to a point is no farther from the next one than that plus the way between: mostly a much better
  // limit than the caller's.
  constexpr double kRounding_m = 1e-5;
  Searches searches(world_);
  const Eigen::Vector3d* before = nullptr;
  double before_m = 0;
  for (const std::uint32_t i : OrderAlongCurve(points_m)) {
    const Eigen::Vector3d& p = points_m[i];
    double limit_m = options_.max_distance_m;
    if (before != nullptr) limit_m = std::min(limit_m, before_m + (p - *before).norm() + kRounding_m);
    Searches::Found found = searches.Find(p, limit_m);
    if (!found.surface.is_any && limit_m < options_.max_distance_m) found = searches.Find(p, options_.max_distance_m);
    answers[i] = Describe(p, options_.max_distance_m, found.surface, found.padding_m);
    if (answers[i].submap == nullptr) continue;
    before = &p;
    before_m = found.reach_m;
  }
}

SurfaceDistance DistanceQuery::Describe(const Eigen::Vector3d& p_map, double limit_m, const NearestSurface& found,
                                        double padding_m) const {
  SurfaceDistance answer;
  const Eigen::Vector3d away = found.p_submap - found.point_submap;
  const double distance_m = away.norm();
  if (!found.is_any || distance_m - padding_m > limit_m) {
    answer.distance_m = limit_m;
    answer.nearest_m.setConstant(std::numeric_limits<double>::quiet_NaN());
    return answer;
  }
  const SubmapInfo& submap = world_.surfaces().index().entries()[found.number].submap().info();
  answer.submap = &submap;
  answer.nearest_m = submap.T_map_submap * found.point_submap;
  const bool is_in_band = distance_m <= submap.truncation_m;
  const QueryWorld::Sight sight = world_.SightAt(p_map, found);
  answer.status = sight.is_seen || options_.unknown_is_free ? DistanceStatus::kOk : DistanceStatus::kUnknown;
  const double side = found.is_behind && (is_in_band || !sight.is_front) ? -1 : 1;
  answer.distance_m = side * distance_m - padding_m;
  constexpr double kLeast_m = 1e-5;  // nearer, rounding would turn the direction
  const Eigen::Vector3d direction =
      distance_m > kLeast_m ? Eigen::Vector3d(side * away / distance_m) : found.normal_submap;
  answer.gradient = submap.T_map_submap.linear() * direction;
  return answer;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/distance_query.h"

#include <cmath>
#include <limits>
#include <utility>

#include "mapping/query/point_order.h"
#include "mapping/query/voxel_sampler.h"

namespace dhpmap {

DistanceQuery::DistanceQuery(std::shared_ptr<const MapSurfaces> surfaces, DistanceOptions options)
    : surfaces_(std::move(surfaces)), options_(std::move(options)) {
  if (options_.scope.IsAll()) return;
  for (const SubmapIndex::Entry& entry : surfaces_->index().entries()) {
    is_held_.push_back(options_.scope.Holds(entry.submap().info()));
  }
}

SurfaceDistance DistanceQuery::At(const Eigen::Vector3d& p_map) const {
  return Describe(p_map, FindNearest(p_map, options_.max_distance_m));
}

void DistanceQuery::At(std::span<const Eigen::Vector3d> points_m, std::span<SurfaceDistance> answers) const {
  // What is nearest to a point is no farther from the next one than that plus the way between: mostly a much better
  // limit than the caller's.
  constexpr double kRounding_m = 1e-5;
  const Eigen::Vector3d* before = nullptr;
  double before_m = 0;
  for (const std::uint32_t i : OrderAlongCurve(points_m)) {
    const Eigen::Vector3d& p = points_m[i];
    double limit_m = options_.max_distance_m;
    if (before != nullptr) limit_m = std::min(limit_m, before_m + (p - *before).norm() + kRounding_m);
    Found found = FindNearest(p, limit_m);
    if (!found.is_any && limit_m < options_.max_distance_m) found = FindNearest(p, options_.max_distance_m);
    answers[i] = Describe(p, found);
    if (answers[i].submap == nullptr) continue;
    before = &p;
    before_m = std::abs(answers[i].distance_m);
  }
}

DistanceQuery::Found DistanceQuery::FindNearest(const Eigen::Vector3d& p_map, double limit_m) const {
  Found best;
  best.nearest.found.distance2_m2 = static_cast<float>(limit_m * limit_m);
  surfaces_->index().VisitNearest(
      p_map, best.nearest.found.Limit2(), [&](std::size_t number, const Eigen::Vector3d& p_submap) {
        const Submap& submap = surfaces_->index().entries()[number].submap();
        if (Holds(number) && surfaces_->surface(number).ImproveNearest(submap, p_submap, best.nearest)) {
          best.number = number;
          best.p_submap = p_submap;
          best.is_any = true;
        }
        return best.nearest.found.Limit2();
      });
  return best;
}

SurfaceDistance DistanceQuery::Describe(const Eigen::Vector3d& p_map, const Found& found) const {
  SurfaceDistance answer;
  const NearestSurface& surface = found.nearest.found;
  const Eigen::Vector3d nearest_submap = found.nearest.corner_m + surface.point_m.cast<double>();
  const Eigen::Vector3d away = found.p_submap - nearest_submap;
  const double distance_m = away.norm();
  if (!found.is_any || distance_m > options_.max_distance_m) {
    answer.distance_m = options_.max_distance_m;
    answer.nearest_m.setConstant(std::numeric_limits<double>::quiet_NaN());
    return answer;
  }
  const SubmapInfo& submap = surfaces_->index().entries()[found.number].submap().info();
  answer.submap = &submap;
  answer.nearest_m = submap.T_map_submap * nearest_submap;
  const Sight sight = SightOf(p_map);
  answer.status = sight.is_seen || options_.unknown_is_free ? DistanceStatus::kOk : DistanceStatus::kUnknown;
  const bool is_behind = surface.side < 0 && (distance_m <= submap.truncation_m || !sight.is_front);
  answer.distance_m = is_behind ? -distance_m : distance_m;
  constexpr double kLeast_m = 1e-5;  // nearer, rounding would turn the direction
  const Eigen::Vector3d direction = distance_m > kLeast_m ? Eigen::Vector3d(away / answer.distance_m)
                                                          : Eigen::Vector3d(surface.normal.cast<double>());
  answer.gradient = submap.T_map_submap.linear() * direction;
  return answer;
}

DistanceQuery::Sight DistanceQuery::SightOf(const Eigen::Vector3d& p_map) const {
  Sight sight;
  surfaces_->index().VisitAround(p_map, [&](const SubmapIndex::Entry& entry) {
    const auto number = static_cast<std::size_t>(&entry - surfaces_->index().entries().data());
    if (sight.is_front || !Holds(number)) return;
    const VoxelSample voxel = SampleVoxelAt(entry.submap(), entry.ToSubmap(p_map));
    if (!voxel.IsObserved()) return;
    sight.is_seen = true;
    sight.is_front |= voxel.distance_m() > 0;
  });
  return sight;
}

}  // namespace dhpmap

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
  return Describe(p_map, NearestSearch(*surfaces_, is_held_).Find(p_map, options_.max_distance_m));
}

void DistanceQuery::At(std::span<const Eigen::Vector3d> points_m, std::span<SurfaceDistance> answers) const {
  // What is nearest to a point is no farther from the next one than that plus the way between: mostly a much better
  // limit than the caller's.
  constexpr double kRounding_m = 1e-5;
  NearestSearch search(*surfaces_, is_held_);
  const Eigen::Vector3d* before = nullptr;
  double before_m = 0;
  for (const std::uint32_t i : OrderAlongCurve(points_m)) {
    const Eigen::Vector3d& p = points_m[i];
    double limit_m = options_.max_distance_m;
    if (before != nullptr) limit_m = std::min(limit_m, before_m + (p - *before).norm() + kRounding_m);
    NearestSurface found = search.Find(p, limit_m);
    if (!found.is_any && limit_m < options_.max_distance_m) found = search.Find(p, options_.max_distance_m);
    answers[i] = Describe(p, found);
    if (answers[i].submap == nullptr) continue;
    before = &p;
    before_m = std::abs(answers[i].distance_m);
  }
}

SurfaceDistance DistanceQuery::Describe(const Eigen::Vector3d& p_map, const NearestSurface& found) const {
  SurfaceDistance answer;
  const Eigen::Vector3d away = found.p_submap - found.point_submap;
  const double distance_m = away.norm();
  if (!found.is_any || distance_m > options_.max_distance_m) {
    answer.distance_m = options_.max_distance_m;
    answer.nearest_m.setConstant(std::numeric_limits<double>::quiet_NaN());
    return answer;
  }
  const SubmapInfo& submap = surfaces_->index().entries()[found.number].submap().info();
  answer.submap = &submap;
  answer.nearest_m = submap.T_map_submap * found.point_submap;
  const bool is_in_band = distance_m <= submap.truncation_m;
  const Sight sight = SightOf(p_map, found);
  answer.status = sight.is_seen || options_.unknown_is_free ? DistanceStatus::kOk : DistanceStatus::kUnknown;
  const bool is_behind = found.is_behind && (is_in_band || !sight.is_front);
  answer.distance_m = is_behind ? -distance_m : distance_m;
  constexpr double kLeast_m = 1e-5;  // nearer, rounding would turn the direction
  const Eigen::Vector3d direction =
      distance_m > kLeast_m ? Eigen::Vector3d(away / answer.distance_m) : found.normal_submap;
  answer.gradient = submap.T_map_submap.linear() * direction;
  return answer;
}

/// Asks the nearest submap first, as it mostly knows.
DistanceQuery::Sight DistanceQuery::SightOf(const Eigen::Vector3d& p_map, const NearestSurface& found) const {
  Sight sight;
  const std::span<const SubmapIndex::Entry> entries = surfaces_->index().entries();
  const auto look = [&sight](const Submap& submap, const Eigen::Vector3d& p_submap) {
    const VoxelSample voxel = SampleVoxelAt(submap, p_submap);
    if (!voxel.IsObserved()) return;
    sight.is_seen = true;
    sight.is_front |= voxel.distance_m() > 0;
  };
  if (entries[found.number].MayHold(found.p_submap)) look(entries[found.number].submap(), found.p_submap);
  if (sight.is_front || (sight.is_seen && !found.is_behind)) return sight;
  surfaces_->index().VisitAround(p_map, [&](const SubmapIndex::Entry& entry) {
    if (sight.is_front || !Holds(static_cast<std::size_t>(&entry - entries.data()))) return;
    look(entry.submap(), entry.ToSubmap(p_map));
  });
  // A voxel beside a surface may have been looked through, too: what submaps hold there counts.
  const MapSnapshot& map = surfaces_->state();
  if (!sight.is_seen && map.free_space()->IsFree(VoxelAt(p_map, map.info().config.voxel_size_m))) {
    sight = {.is_seen = true, .is_front = true};
  }
  return sight;
}

}  // namespace dhpmap

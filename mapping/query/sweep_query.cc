// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/sweep_query.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mapping/query/near_triangles.h"
#include "mapping/query/unseen_voxels.h"

namespace dhpmap {
namespace {

/// Work of one step of a sphere, besides the objects that it visits.
constexpr std::int64_t kStepWork = 64;

/// An upper bound of the motion of any point on the sphere's surface.
double WayOf(const SphereKnot& from, const SphereKnot& to) {
  return (to.center_m - from.center_m).norm() + std::abs(to.radius_m - from.radius_m);
}

Capsule SweptBy(const SphereKnot& from, const SphereKnot& to) {
  return {from.center_m, to.center_m, std::max(from.radius_m, to.radius_m)};
}

double At(const SphereKnot& from, const SphereKnot& to, double share) { return from.at + share * (to.at - from.at); }

}  // namespace

SweepQuery::SweepQuery(std::shared_ptr<const MapSurfaces> surfaces, BodyOptions options, bool counts_inside)
    : options_(std::move(options)),
      counts_inside_(counts_inside),
      world_(surfaces, options_.scope),
      distances_(surfaces, {.max_distance_m = options_.max_distance_m, .scope = options_.scope}),
      bodies_(std::move(surfaces), options_) {}

SweepAnswer SweepQuery::First(std::span<const SphereKnot> knots, double until, const std::stop_token& stop,
                              WorkBudget* work) const {
  SweepAnswer answer{.first = FirstSurface(knots, until, stop, work)};
  if (options_.unknown == UnknownSpace::kFree) return answer;
  const double before = answer.first ? std::min(until, answer.first->at) : until;
  auto unseen = FirstUnseen(knots, before, stop, work);
  if (!unseen || (answer.first && unseen->at >= answer.first->at)) return answer;
  answer.unknown_at = unseen->at;
  if (options_.unknown == UnknownSpace::kOccupied) answer.first = std::move(unseen);
  return answer;
}

std::optional<SweepContact> SweepQuery::FirstSurface(std::span<const SphereKnot> knots, double until,
                                                     const std::stop_token& stop, WorkBudget* work) const {
  if (knots.empty() || knots.front().at > until) return std::nullopt;
  double rest_m = 0;
  for (std::size_t i = 0; i + 1 < knots.size() && knots[i].at <= until; ++i) rest_m += WayOf(knots[i], knots[i + 1]);
  for (std::size_t i = 0; i < knots.size() && knots[i].at <= until;) {
    if (stop.stop_requested() || !SpendOf(work, kStepWork)) return std::nullopt;
    const SphereKnot& here = knots[i];
    const double look_m = std::min(std::max(rest_m, 0.0), options_.max_distance_m);
    const SurfaceDistance distance = distances_.Within(here.center_m, here.radius_m + look_m);
    const double distance_m = counts_inside_ ? distance.distance_m : std::abs(distance.distance_m);
    double clear_m = distance_m - here.radius_m;
    if (distance.submap != nullptr && clear_m <= 0) {
      return SweepContact{here.at, {distance.submap, -clear_m, distance.nearest_m, distance.gradient}, -clear_m};
    }
    if (i == 0 && counts_inside_ && distance.submap == nullptr) {
      if (const auto inside = bodies_.InsideOf(here.center_m)) {
        const double depth_m = here.radius_m - inside->distance_m;
        return SweepContact{here.at, {inside->submap, depth_m, inside->nearest_m, inside->gradient}, depth_m};
      }
    }
    const std::size_t first = i;
    for (; i + 1 < knots.size(); ++i) {
      const double way_m = WayOf(knots[i], knots[i + 1]);
      if (way_m > clear_m) break;
      clear_m -= way_m;
      rest_m -= way_m;
    }
    if (i + 1 >= knots.size()) return std::nullopt;
    if (i > first) continue;
    if (const auto contact = FirstBetween(here, knots[i + 1], work)) {
      return contact->at <= until ? contact : std::nullopt;
    }
    rest_m -= WayOf(here, knots[i + 1]);
    ++i;
  }
  return std::nullopt;
}

std::optional<SweepContact> SweepQuery::FirstBetween(const SphereKnot& from, const SphereKnot& to,
                                                     WorkBudget* work) const {
  double best = std::numeric_limits<double>::infinity();
  std::size_t number = 0;
  BodyContact contact;
  const auto visit = [&](const NearTriangle<Capsule>& near) {
    const SphereStep step{near.body.a_m, near.body.b_m - near.body.a_m, from.radius_m + near.padding_m,
                          to.radius_m - from.radius_m};
    const auto share = TimeOfTouch(step, near.triangle);
    if (!share || *share >= best) return true;
    best = *share;
    number = near.number;
    const Eigen::Vector3d center = step.CenterAt(best);
    const Eigen::Vector3d point = NearestPointOf(near.triangle, center.cast<float>()).cast<double>();
    contact.point_m = near.InMap(point);
    contact.normal = near.TurnedToMap((center - point).stableNormalized());
    return true;
  };
  VisitNear(world_, SweptBy(from, to), visit, work);
  if (!(best <= 1)) return std::nullopt;
  contact.submap = &world_.surfaces().index().entries()[number].submap().info();
  contact.depth_m = DepthAt(to, number);
  return SweepContact{At(from, to, best), contact};
}

double SweepQuery::DepthAt(const SphereKnot& knot, std::size_t number) const {
  std::vector<bool> is_held(world_.surfaces().index().entries().size());
  is_held[number] = true;
  const double reach_m = knot.radius_m + world_.padding_m(number);
  const NearestSurface found =
      NearestSearch(world_.surfaces(), is_held, world_.is_held()).Find(knot.center_m, options_.max_distance_m);
  if (!found.is_any) return 0;
  const double distance_m = (found.p_submap - found.point_submap).norm();
  return std::max(0.0, reach_m - (found.is_behind && !found.is_beside ? -distance_m : distance_m));
}

/// By bisection: halves whose box is entirely free are not divided further.
std::optional<SweepContact> SweepQuery::FirstUnseen(std::span<const SphereKnot> knots, double until,
                                                    const std::stop_token& stop, WorkBudget* work) const {
  if (knots.empty() || knots.front().at > until || stop.stop_requested()) return std::nullopt;
  if (!SpendOf(work, static_cast<std::int64_t>(knots.size()))) return std::nullopt;
  if (knots.size() <= 2) {
    auto contact = FirstUnseenBetween(knots.front(), knots.back(), work);
    return contact && contact->at <= until ? contact : std::nullopt;
  }
  Eigen::AlignedBox3d box;
  for (const SphereKnot& knot : knots) {
    box.extend(BoundsOf(AtLeast(kHalfDiagonal_vox * world_.voxel_size_m(), SweptBy(knot, knot))));
  }
  if (IsFreeThroughout(world_, box)) return std::nullopt;
  const std::size_t middle = knots.size() / 2;
  if (auto contact = FirstUnseen(knots.first(middle + 1), until, stop, work)) return contact;
  return FirstUnseen(knots.subspan(middle), until, stop, work);
}

std::optional<SweepContact> SweepQuery::FirstUnseenBetween(const SphereKnot& from, const SphereKnot& to,
                                                           WorkBudget* work) const {
  const double half_diagonal_m = kHalfDiagonal_vox * world_.voxel_size_m();
  const double radius_m = std::max(from.radius_m, half_diagonal_m);
  const SphereStep step{from.center_m, to.center_m - from.center_m, radius_m,
                        std::max(to.radius_m, half_diagonal_m) - radius_m};
  double best = std::numeric_limits<double>::infinity();
  SweepContact contact;
  const auto visit = [&](VoxelIndex voxel) {
    const Eigen::Vector3d centre = VoxelCentre(voxel, world_.voxel_size_m());
    const auto share = TimeOfTouch(step, centre);
    if (!share || *share >= best || IsAllowed(world_, voxel, options_.max_distance_m, work)) return true;
    best = *share;
    contact = {At(from, to, best), {.point_m = centre}};
    return best > 0;
  };
  VisitUnseen(world_, SweptBy(from, to), visit, work);
  return best <= 1 ? std::optional(contact) : std::nullopt;
}

}  // namespace dhpmap

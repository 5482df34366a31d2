// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/clearance_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dhpmap {
namespace {

/// A lower bound of the distance to the nearest surface on a straight motion of length `way_m` whose ends have
/// distances of at least `a_m` and `b_m`. The squared distance to a point, minus the square of the distance moved, is
/// linear along the motion; the minimum over several points is concave. `share`: position of the bound's minimum.
double LeastOnTheWay(double a_m, double b_m, double way_m, double& share) {
  a_m = std::max({a_m, b_m - way_m, 0.0});
  b_m = std::max({b_m, a_m - way_m, 0.0});
  const double a2 = a_m * a_m, b2 = b_m * b_m, way2 = way_m * way_m;
  share = way2 > 0 ? std::clamp(0.5 * (way2 + a2 - b2) / way2, 0.0, 1.0) : 0.0;
  return std::sqrt(std::max(0.0, (1 - share) * a2 + share * b2 - share * (1 - share) * way2));
}

}  // namespace

ClearanceQuery::ClearanceQuery(std::shared_ptr<const MapSurfaces> surfaces, const BodyOptions& options)
    : most_distance_m_(options.max_distance_m),
      padding_(options.scope.padding),
      distances_(surfaces,
                 {.max_distance_m = options.max_distance_m, .unknown_is_free = true, .scope = options.scope}) {
  const QueryWorld world(std::move(surfaces), options.scope);
  for (const QueryWorld::Grown& grown : world.grown()) paddings_m_.push_back(grown.padding_m);
}

/// Searches the motion of one sphere by bisection, where it may be nearer than the best result so far.
class ClearanceQuery::Search {
 public:
  Search(const ClearanceQuery& query, std::span<const SphereKnot> knots, LeastClearance& least,
         const std::stop_token& stop, WorkBudget* work)
      : query_(query), knots_(knots), least_(least), stop_(stop), work_(work) {}

  void Run() {
    way_m_.reserve(knots_.size());
    for (std::size_t i = 0; i < knots_.size(); ++i) {
      way_m_.push_back(i == 0 ? 0 : way_m_.back() + WayOf(knots_[i - 1], knots_[i]));
    }
    if (knots_.empty()) return;
    const double first_m = ClearOf(knots_.front(), way_m_.back());
    if (knots_.size() > 1) LowerAmong(0, knots_.size() - 1, first_m, ClearOf(knots_.back(), way_m_.back()));
  }

 private:
  /// An upper bound of the motion of any point on the sphere's surface.
  static double WayOf(const SphereKnot& from, const SphereKnot& to) {
    return (to.center_m - from.center_m).norm() + std::abs(to.radius_m - from.radius_m);
  }
  [[nodiscard]] bool MayBeNearer(double least_m) const { return least_m < least_.distance_m - kTolerance_m; }

  /// The clearance of a sphere; if nothing is within reach of a motion of `way_m`, a lower bound.
  double ClearOf(const SphereKnot& sphere, double way_m) {
    constexpr std::int64_t kLookWork = 64;
    is_over_ = is_over_ || stop_.stop_requested() || !SpendOf(work_, kLookWork);
    const double look_m = std::min(least_.distance_m + way_m, query_.most_distance_m_);
    if (is_over_) return look_m;
    const SurfaceDistance nearest = query_.distances_.Within(sphere.center_m, sphere.radius_m + look_m);
    if (nearest.submap == nullptr) return look_m;
    const double clear_m =
        (nearest.nearest_m - sphere.center_m).norm() - query_.padding_.Of(*nearest.submap) - sphere.radius_m;
    if (clear_m < least_.distance_m || (clear_m == least_.distance_m && least_.submap == nullptr)) {
      least_ = {clear_m, sphere.at, nearest.nearest_m, nearest.submap};
    }
    return clear_m;
  }

  /// Searches between two knots with the given clearances.
  void LowerAmong(std::size_t from, std::size_t to, double from_m, double to_m) {
    const double way_m = way_m_[to] - way_m_[from];
    if (is_over_ || !MayBeNearer(0.5 * (from_m + to_m - way_m))) return;
    if (to == from + 1) return LowerBetween(knots_[from], knots_[to], from_m, to_m);
    const std::size_t middle = from + (to - from) / 2;
    const double middle_m = ClearOf(knots_[middle], way_m);
    if (from_m < to_m) {
      LowerAmong(from, middle, from_m, middle_m);
      LowerAmong(middle, to, middle_m, to_m);
    } else {
      LowerAmong(middle, to, middle_m, to_m);
      LowerAmong(from, middle, from_m, middle_m);
    }
  }

  /// The same for a straight motion.
  void LowerBetween(const SphereKnot& from, const SphereKnot& to, double from_m, double to_m) {
    const double way_m = WayOf(from, to), center_way_m = (to.center_m - from.center_m).norm();
    double share = 0, least_m = std::numeric_limits<double>::infinity();
    for (const double padding_m : query_.paddings_m_) {  // padding of some objects
      double nearest_at = 0;
      const double to_center_m =
          LeastOnTheWay(from_m + from.radius_m + padding_m, to_m + to.radius_m + padding_m, center_way_m, nearest_at);
      const double clear_m = to_center_m - padding_m - std::max(from.radius_m, to.radius_m);
      if (clear_m < least_m) share = nearest_at;
      least_m = std::min(least_m, clear_m);
    }
    if (is_over_ || !MayBeNearer(std::max(0.5 * (from_m + to_m - way_m), least_m))) return;
    share = std::clamp(share, 0.2, 0.8);
    const SphereKnot middle{from.at + share * (to.at - from.at), from.center_m + share * (to.center_m - from.center_m),
                            from.radius_m + share * (to.radius_m - from.radius_m)};
    const double middle_m = ClearOf(middle, way_m);
    LowerBetween(from, middle, from_m, middle_m);
    LowerBetween(middle, to, middle_m, to_m);
  }

  const ClearanceQuery& query_;
  const std::span<const SphereKnot> knots_;
  LeastClearance& least_;
  const std::stop_token& stop_;
  WorkBudget* const work_;
  std::vector<double> way_m_;  ///< length up to each knot
  bool is_over_ = false;
};

bool ClearanceQuery::Lower(std::span<const SphereKnot> knots, LeastClearance& least, const std::stop_token& stop,
                           WorkBudget* work) const {
  const double before_m = least.distance_m;
  const SubmapInfo* const submap_before = least.submap;
  Search(*this, knots, least, stop, work).Run();
  return least.distance_m < before_m || least.submap != submap_before;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/distance_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "mapping/geometry/point_order.h"
#include "mapping/surfaces/find_field_cell.h"

namespace dhpmap {
namespace {

constexpr double kLeast_m = 1e-5;  // nearer than this, rounding would dominate the direction

SurfaceDistance Clamped(double limit_m) {
  SurfaceDistance answer;
  answer.distance_m = limit_m;
  answer.nearest_m.setConstant(std::numeric_limits<double>::quiet_NaN());
  return answer;
}

NearField::List ListAt(const NearField& field, const Eigen::Vector3f& p) {
  return field.is_far() ? NearField::List{} : field.ListOf(field.CubeAt(p));
}

}  // namespace

/// Finds the nearest of all grown surfaces, each with its own padding.
class DistanceQuery::Searches {
 public:
  explicit Searches(const QueryWorld& world) {
    for (const QueryWorld::Grown& grown : world.grown()) {
      parts_.push_back({grown.padding_m, NearestSearch(world.surfaces(), grown.is_held, world.is_held())});
    }
  }

  struct Found {
    NearestSurface surface;
    double padding_m = 0;
    double reach_m = 0;  ///< to the surface from either side, minus its padding
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
    : world_(std::move(surfaces), options.scope),
      options_(std::move(options)),
      takes_fields_(options_.tolerance_vox >= NearField::kTolerance_vox && world_.grown().size() == 1) {}

SurfaceDistance DistanceQuery::At(const Eigen::Vector3d& p_map) const {
  if (takes_fields_) {
    DistanceFields::Slot* slot = world_.surfaces().fields().SlotAt(p_map);
    const FieldCell* cell = slot == nullptr ? nullptr : FindFieldCell(world_.surfaces(), *slot, p_map);
    if (cell != nullptr) {
      const Eigen::Vector3f p = (p_map - cell->field->centre_m()).cast<float>();
      SurfaceDistance answer;
      double within_m = options_.max_distance_m;
      if (TryField(p_map, *cell, p, ListAt(*cell->field, p), answer, within_m)) return answer;
      if (within_m < options_.max_distance_m) answer = Within(p_map, within_m);
      if (answer.submap != nullptr) return answer;
    }
  }
  return Within(p_map, options_.max_distance_m);
}

SurfaceDistance DistanceQuery::Within(const Eigen::Vector3d& p_map, double limit_m) const {
  const Searches::Found found = Searches(world_).Find(p_map, limit_m);
  return Describe(p_map, limit_m, found.surface, found.padding_m);
}

bool DistanceQuery::AnyCloserThan(const Eigen::Vector3d& p_map, double radius_m) const {
  return std::any_of(world_.grown().begin(), world_.grown().end(), [&](const QueryWorld::Grown& grown) {
    return NearestSearch(world_.surfaces(), grown.is_held, world_.is_held())
        .IsAnyWithin(p_map, radius_m + grown.padding_m);
  });
}

/// The surface nearest to one point also limits the distance of the next point, usually much more than the caller's
/// limit.
class DistanceQuery::Limit {
 public:
  explicit Limit(double most_m) : most_m_(most_m) {}
  [[nodiscard]] double At(const Eigen::Vector3d& p) const {
    if (!is_any_) return most_m_;
    constexpr double kRounding_m = 1e-5, kRounding = 1 + 1e-5;
    return std::min(most_m_, kRounding * (p - nearest_m_).norm() + kRounding_m - padding_m_);
  }
  /// Takes a surface grown by `padding_m`.
  void Learn(const Eigen::Vector3d& nearest_m, double padding_m) {
    is_any_ = true;
    nearest_m_ = nearest_m;
    padding_m_ = padding_m;
  }

 private:
  double most_m_;
  bool is_any_ = false;
  Eigen::Vector3d nearest_m_ = Eigen::Vector3d::Zero();
  double padding_m_ = 0;
};

void DistanceQuery::At(std::span<const Eigen::Vector3d> points_m, std::span<SurfaceDistance> answers) const {
  AtOrdered(points_m, OrderAlongCurve(points_m), answers);
}

void DistanceQuery::AtInOrder(std::span<const Eigen::Vector3d> points_m, std::span<SurfaceDistance> answers) const {
  std::vector<std::uint32_t> order(points_m.size());
  std::iota(order.begin(), order.end(), 0u);
  AtOrdered(points_m, std::move(order), answers);
}

void DistanceQuery::AtOrdered(std::span<const Eigen::Vector3d> points_m, std::vector<std::uint32_t> order,
                              std::span<SurfaceDistance> answers) const {
  if (world_.grown().size() == 1) {
    AtTogether(points_m, takes_fields_ ? AtByFields(points_m, order, answers) : AllOf(order), answers);
    return;
  }
  Searches searches(world_);
  Limit limit(options_.max_distance_m);
  for (const std::uint32_t i : order) {
    const Eigen::Vector3d& p = points_m[i];
    const double limit_m = limit.At(p);
    Searches::Found found = searches.Find(p, limit_m);
    if (!found.surface.is_any && limit_m < options_.max_distance_m) found = searches.Find(p, options_.max_distance_m);
    answers[i] = Describe(p, options_.max_distance_m, found.surface, found.padding_m);
    if (answers[i].submap != nullptr) limit.Learn(answers[i].nearest_m, found.padding_m);
  }
}

std::vector<DistanceQuery::Open> DistanceQuery::AllOf(std::span<const std::uint32_t> order) const {
  std::vector<Open> open;
  open.reserve(order.size());
  for (const std::uint32_t point : order) open.push_back({point, options_.max_distance_m});
  return open;
}

/// For equal padding everywhere: one search for each point, several interleaved to hide memory latency.
void DistanceQuery::AtTogether(std::span<const Eigen::Vector3d> points_m, std::span<const Open> open,
                               std::span<SurfaceDistance> answers) const {
  constexpr std::size_t kMostInFlight = 16;
  struct Flight {
    NearestSearch search;
    std::uint32_t point = 0;
    double limit_m = 0;
  };
  const double padding_m = world_.grown()[0].padding_m;
  const std::vector<bool>& is_held = world_.grown()[0].is_held;
  const double most_m = options_.max_distance_m;
  std::size_t next = 0;
  Limit limit(most_m);
  const auto start_next = [&](Flight& flight) {
    flight.point = open[next].point;
    flight.limit_m = std::min(limit.At(points_m[flight.point]), open[next++].within_m);
    flight.search.Start(points_m[flight.point], flight.limit_m + padding_m);
  };
  const auto finish = [&](Flight& flight) {
    const Eigen::Vector3d& p = points_m[flight.point];
    NearestSurface found = flight.search.Found();
    if (!found.is_any && flight.limit_m < most_m) found = flight.search.Find(p, most_m + padding_m);
    answers[flight.point] = Describe(p, most_m, found, padding_m);
    if (answers[flight.point].submap != nullptr) limit.Learn(answers[flight.point].nearest_m, padding_m);
  };
  std::vector<Flight> flights(std::min(open.size(), kMostInFlight),
                              Flight{NearestSearch(world_.surfaces(), is_held, world_.is_held())});
  std::vector<Flight*> in_flight;
  for (Flight& flight : flights) {
    start_next(flight);
    in_flight.push_back(&flight);
  }
  while (!in_flight.empty()) {
    std::erase_if(in_flight, [&](Flight* flight) {
      if (!flight->search.Step()) return false;
      finish(*flight);
      if (next == open.size()) return true;
      start_next(*flight);
      return false;
    });
  }
}

/// Answers points whose cell has a field, several interleaved step by step to hide memory latency. Returns the others,
/// in their order.
std::vector<DistanceQuery::Open> DistanceQuery::AtByFields(std::span<const Eigen::Vector3d> points_m,
                                                           std::span<const std::uint32_t> order,
                                                           std::span<SurfaceDistance> answers) const {
  constexpr std::size_t kSideBySide = 16;
  struct Lookup {
    DistanceFields::Slot* slot;
    const FieldCell* cell;
    Eigen::Vector3f p;
    std::uint32_t cube;
    NearField::List list;
  };
  std::array<Lookup, kSideBySide> lookups;
  const DistanceFields& fields = world_.surfaces().fields();
  std::vector<Open> others;
  for (std::size_t first = 0; first < order.size(); first += kSideBySide) {
    const std::span<const std::uint32_t> some = order.subspan(first, std::min(kSideBySide, order.size() - first));
    for (std::size_t i = 0; i < some.size(); ++i) {
      lookups[i].slot = fields.SlotAt(points_m[some[i]]);
      __builtin_prefetch(lookups[i].slot);
    }
    for (std::size_t i = 0; i < some.size(); ++i) {
      Lookup& lookup = lookups[i];
      lookup.cell =
          lookup.slot == nullptr ? nullptr : FindFieldCell(world_.surfaces(), *lookup.slot, points_m[some[i]]);
      __builtin_prefetch(lookup.cell);
    }
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (lookups[i].cell != nullptr) __builtin_prefetch(lookups[i].cell->field.get());
    }
    for (std::size_t i = 0; i < some.size(); ++i) {
      Lookup& lookup = lookups[i];
      if (lookup.cell == nullptr) continue;
      const NearField& field = *lookup.cell->field;
      lookup.p = (points_m[some[i]] - field.centre_m()).cast<float>();
      if (field.is_far()) continue;
      lookup.cube = field.CubeAt(lookup.p);
      field.PrefetchCube(lookup.cube);
    }
    for (std::size_t i = 0; i < some.size(); ++i) {
      Lookup& lookup = lookups[i];
      lookup.list = {};
      if (lookup.cell == nullptr || lookup.cell->field->is_far()) continue;
      lookup.list = lookup.cell->field->ListOf(lookup.cube);
      lookup.cell->field->Prefetch(lookup.list);
    }
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (lookups[i].cell != nullptr) lookups[i].cell->field->PrefetchTriangles(lookups[i].list);
    }
    for (std::size_t i = 0; i < some.size(); ++i) {
      const Lookup& lookup = lookups[i];
      SurfaceDistance& answer = answers[some[i]];
      double within_m = options_.max_distance_m;
      if (lookup.cell == nullptr ||
          !TryField(points_m[some[i]], *lookup.cell, lookup.p, lookup.list, answer, within_m)) {
        others.push_back({some[i], within_m});
      }
    }
  }
  return others;
}

/// True if the field has the answer; else may lower `within_m`. The field's nearest surface is the answer if it is
/// among the surfaces of the query.
bool DistanceQuery::TryField(const Eigen::Vector3d& p_map, const FieldCell& cell, const Eigen::Vector3f& p,
                             const NearField::List& list, SurfaceDistance& answer, double& within_m) const {
  const double limit_m = options_.max_distance_m, padding_m = world_.most_padding_m();
  if (cell.field->is_far()) {
    if (limit_m + padding_m > NearField::kReach_m) return false;
    answer = Clamped(limit_m);
    return true;
  }
  if (list.count == 0) return false;
  const NearField::Nearest nearest = cell.field->Find(p, list);
  NearestSurface found{.is_any = true, .number = cell.numbers[nearest.submap], .is_behind = nearest.is_behind};
  if (!world_.IsInTheWay(found.number) || !world_.HoldsAll(cell.field->needed(nearest.submap))) return false;
  const double distance_m = static_cast<double>(nearest.away.norm());
  if (distance_m - padding_m > limit_m) {
    answer = Clamped(limit_m);
    return true;
  }
  constexpr double kRounding_m = 1e-4;
  within_m = std::min(limit_m, distance_m - padding_m + kRounding_m);
  found.p_submap = world_.surfaces().index().entries()[found.number].ToSubmap(p_map);
  found.sight = &cell.sight;
  if (!list.is_side_known) {
    // The unknown side does not matter if a submap observed the point in front.
    const double band_m = world_.surfaces().index().entries()[found.number].submap().info().truncation_m;
    if (distance_m <= band_m || !world_.SightAt(p_map, found).is_front) return false;
    found.is_behind = false;
  }
  const bool may_end = list.may_end || !world_.is_held().empty();  // at excluded neighbours, too
  if (found.is_behind && may_end && !nearest.is_across) {
    // The end does not matter if the place itself was observed inside or, beyond the band, in front.
    const double band_m = world_.surfaces().index().entries()[found.number].submap().info().truncation_m;
    const QueryWorld::Sight sight = world_.SightAt(p_map, found);
    if (!sight.is_seen || (sight.is_front && distance_m <= band_m)) return false;
  }
  double side = 1;
  const Eigen::Vector3d away = nearest.away.cast<double>();
  Tell(p_map, found, {nearest.normal.cast<double>(), away}, padding_m, answer, side);
  answer.nearest_m = p_map - away;
  answer.gradient = distance_m > kLeast_m ? Eigen::Vector3d(side / distance_m * away)
                                          : Eigen::Vector3d(nearest.normal.stableNormalized().cast<double>());
  return true;
}

SurfaceDistance DistanceQuery::Describe(const Eigen::Vector3d& p_map, double limit_m, const NearestSurface& found,
                                        double padding_m) const {
  const Eigen::Vector3d away = found.p_submap - found.point_submap;
  const double distance_m = away.norm();
  if (!found.is_any || distance_m - padding_m > limit_m) return Clamped(limit_m);
  SurfaceDistance answer;
  double side = 1;
  Tell(p_map, found, {found.normal_submap, away}, padding_m, answer, side);
  const Transform& T_map_submap = answer.submap->T_map_submap;
  answer.nearest_m = T_map_submap * found.point_submap;
  const Eigen::Vector3d direction =
      distance_m > kLeast_m ? Eigen::Vector3d(side * away / distance_m) : found.normal_submap;
  answer.gradient = T_map_submap.linear() * direction;
  return answer;
}

/// Sets the surface's object, the side of the point, and whether it was observed.
void DistanceQuery::Tell(const Eigen::Vector3d& p_map, const NearestSurface& found, const Way& way, double padding_m,
                         SurfaceDistance& answer, double& side) const {
  const double distance_m = way.away_m.norm();
  const SubmapInfo& submap = world_.surfaces().index().entries()[found.number].submap().info();
  answer.submap = &submap;
  const bool is_in_band = distance_m <= submap.truncation_m;
  // In front of the surface or within its band, a point only needs to be observed. Farther behind, it must not have
  // been observed in front of any surface.
  QueryWorld::Sight sight;
  const bool needs_front = found.is_behind && (!is_in_band || found.is_beside);
  const bool is_looked_at = needs_front || !options_.unknown_is_free;
  if (needs_front) sight = world_.SightAt(p_map, found);
  else if (is_looked_at) sight.is_seen = world_.IsSeenAt(p_map, found);
  answer.status = sight.is_seen || options_.unknown_is_free ? DistanceStatus::kOk : DistanceStatus::kUnknown;
  // At its edge a surface does not determine the side; an observed voxel there does.
  bool is_inside =
      found.is_behind && (found.is_beside ? sight.is_seen && !sight.is_front : is_in_band || !sight.is_front);
  if (!is_inside && !(is_looked_at ? sight.is_seen : world_.IsSeenAt(p_map, found))) {
    is_inside = world_.IsInsideThing(p_map, way.IsAcross());
  }
  side = is_inside ? -1 : 1;
  answer.distance_m = side * distance_m - padding_m;
}

}  // namespace dhpmap

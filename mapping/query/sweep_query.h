// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>

#include "mapping/geometry/moving_sphere.h"
#include "mapping/query/body_query.h"

namespace dhpmap {

/// The first contact of a moving sphere.
struct SweepContact {
  double at = 0;  ///< time, in waypoints
  BodyContact contact;
  double depth_then_m = 0;  ///< depth at that time: above 0 only at the start, or inside an object
};
struct SweepAnswer {
  std::optional<SweepContact> first;
  std::optional<double> unknown_at;  ///< time when it first contains unseen space, if before any contact
};

/// Contacts of moving spheres in a state of a map, with the same obstacles as BodyQuery. The check is continuous: it
/// misses no contact at any speed. Far from surfaces a step is as long as the distance to the nearest surface; near
/// surfaces the time of contact with each triangle is computed from knot to knot. The inside of objects is tested at
/// the first knot and wherever a distance is computed: a sphere can get inside only through a surface or unseen space.
/// Immutable, thread-safe.
class SweepQuery {
 public:
  /// Without `counts_inside` only surfaces are obstacles, from both sides: to find further contacts after a sphere has
  /// passed through a surface.
  SweepQuery(std::shared_ptr<const MapSurfaces> surfaces, BodyOptions options, bool counts_inside = true);

  /// The first contact no later than `until`. Knots are in the map frame, in order of time, finite. The depth of a
  /// contact between knots is that at the next knot, or 0. Ends soon after a `stop` request or when `work` is spent;
  /// the result is then invalid.
  [[nodiscard]] SweepAnswer First(std::span<const SphereKnot> knots,
                                  double until = std::numeric_limits<double>::infinity(),
                                  const std::stop_token& stop = {}, WorkBudget* work = nullptr) const;

  /// See BodyQuery.
  [[nodiscard]] std::optional<SurfaceDistance> InsideOf(const Eigen::Vector3d& p_map) const {
    return bodies_.InsideOf(p_map);
  }
  [[nodiscard]] const BodyOptions& options() const { return options_; }
  [[nodiscard]] const QueryWorld& world() const { return world_; }

 private:
  [[nodiscard]] std::optional<SweepContact> FirstSurface(std::span<const SphereKnot> knots, double until,
                                                         const std::stop_token& stop, WorkBudget* work) const;
  [[nodiscard]] std::optional<SweepContact> FirstBetween(const SphereKnot& from, const SphereKnot& to,
                                                         WorkBudget* work) const;
  [[nodiscard]] std::optional<SweepContact> FirstUnseen(std::span<const SphereKnot> knots, double until,
                                                        const std::stop_token& stop, WorkBudget* work) const;
  [[nodiscard]] std::optional<SweepContact> FirstUnseenBetween(const SphereKnot& from, const SphereKnot& to,
                                                               WorkBudget* work) const;
  [[nodiscard]] double DepthAt(const SphereKnot& knot, std::size_t number) const;

  BodyOptions options_;
  bool counts_inside_;
  QueryWorld world_;
  DistanceQuery distances_;
  BodyQuery bodies_;
};

}  // namespace dhpmap

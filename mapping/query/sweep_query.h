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

/// What a moving sphere meets first.
struct SweepContact {
  double at = 0;  ///< when, in waypoints
  BodyContact contact;
  double depth_then_m = 0;  ///< how deep at that moment: above 0 only where the way begins, or inside something
};
struct SweepAnswer {
  std::optional<SweepContact> first;
  std::optional<double> unknown_at;  ///< when it first is in part where nobody has seen, before it meets anything
};

/// What spheres meet on their way through a state of a map: the same that is in the way of bodies (BodyQuery), at any
/// moment of the way, however fast. Where surfaces are far it goes as far as they are in one step, where they are near
/// from knot to knot by when it touches each triangle. The inside of objects counts at the first knot and wherever it
/// looks for the distance: to get inside it has to go through a surface, or through what nobody has seen.
/// Immutable, thread-safe.
class SweepQuery {
 public:
  /// Without `counts_inside` only surfaces are in the way, from both sides: for what else is met by those who have gone
  /// through one.
  SweepQuery(std::shared_ptr<const MapSurfaces> surfaces, BodyOptions options, bool counts_inside = true);

  /// Of the map frame, in the order of time; finite. Only what happens no later than `until`. The depth of a contact
  /// on the way is that at the next knot, or 0. Gives up soon after `stop` is requested or `work` is over: then the
  /// answer means nothing.
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

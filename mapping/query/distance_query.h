// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "mapping/query/query_scope.h"
#include "mapping/query/query_world.h"
#include "mapping/surfaces/nearest_search.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

enum class DistanceStatus : std::uint8_t {
  kOk,
  kClamped,  ///< no surface within the limit
  kUnknown,  ///< the distance is right, but nobody has seen what is at the point
};

/// How far a point is from the nearest surface of the map.
struct SurfaceDistance {
  DistanceStatus status = DistanceStatus::kClamped;
  /// Euclidean. Negative behind a surface: in the submap's band, and farther behind where the point was not seen in
  /// front of any, nor free. Beside a surface, where it ends at the nearest point, only if the point's own voxel was
  /// seen, and behind a surface. And negative where nobody has seen the point and it is inside of a thing, whosesoever
  /// surface is nearest: see thing_inside.h. Less the submap's padding. Clamped: the limit.
  double distance_m = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< of the distance, map frame, unit; clamped: zero
  Eigen::Vector3d nearest_m;                           ///< on the surface, map frame; clamped: NaN
  const SubmapInfo* submap = nullptr;                  ///< whose surface; null: clamped. Valid as long as the surfaces
};

struct DistanceOptions {
  double max_distance_m = 3;     ///< finite, positive
  bool unknown_is_free = false;  ///< unseen points are OK, not UNKNOWN
  /// How much too long a distance may be, in voxels of the map. From NearField::kTolerance_vox on, and if all surfaces
  /// are grown alike, near fields answer where there are any, several times as fast; below, or elsewhere: exact.
  double tolerance_vox = 0;
  QueryScope scope;
};

/// Distances to the zero surface of a state of a map: the nearest point of all submaps' surfaces (ExtractTileSurface),
/// each at its pose and grown by its padding. Exact to 1e-5 of the distance and 1e-4 voxels, by rounding, unless a
/// tolerance allows for more: then |distance + padding| is never too short, and too long by no more than
/// NearField::kTolerance_vox voxels and no more than a share of NearField::kShare; the nearest point, gradient and
/// submap are those of that point of a surface. Within() and AnyCloserThan() are always exact. Immutable, thread-safe.
class DistanceQuery {
 public:
  DistanceQuery(std::shared_ptr<const MapSurfaces> surfaces, DistanceOptions options);

  /// `p_map`: finite, metres of the map frame.
  [[nodiscard]] SurfaceDistance At(const Eigen::Vector3d& p_map) const;

  /// The same, exactly, with a limit of its own: finite; less than 0 only if something is grown by as much.
  [[nodiscard]] SurfaceDistance Within(const Eigen::Vector3d& p_map, double limit_m) const;

  /// The same for many points, in their order; faster, as it goes from each to one close by. As many answers as points.
  void At(std::span<const Eigen::Vector3d> points_m, std::span<SurfaceDistance> answers) const;
  /// The same for points that already come in an order in which each is close to the one before: see OrderAlongCurve.
  void AtInOrder(std::span<const Eigen::Vector3d> points_m, std::span<SurfaceDistance> answers) const;

  /// Whether any grown surface is within `radius_m` (finite, not negative) of a point, on whichever side of it: told as
  /// soon as it is known, in no time where nothing is near. What is farther by 1e-5 of that may count, too.
  [[nodiscard]] bool AnyCloserThan(const Eigen::Vector3d& p_map, double radius_m) const;

 private:
  class Searches;
  class Limit;
  void AtOrdered(std::span<const Eigen::Vector3d> points_m, std::vector<std::uint32_t> order,
                 std::span<SurfaceDistance> answers) const;
  /// From a surface, whose normal may be of any length, to a point.
  struct Way {
    Eigen::Vector3d normal, away_m;
    /// Straight off the front, to a degree.
    [[nodiscard]] bool IsAcross() const {
      constexpr double kCosine = 0.9998;
      return normal.dot(away_m) >= kCosine * normal.norm() * away_m.norm();
    }
  };
  /// A point that has yet to be searched for, and how far it is to something, if that is known.
  struct Open {
    std::uint32_t point;
    double within_m;
  };
  void AtTogether(std::span<const Eigen::Vector3d> points_m, std::span<const Open> open,
                  std::span<SurfaceDistance> answers) const;
  [[nodiscard]] std::vector<Open> AllOf(std::span<const std::uint32_t> order) const;
  std::vector<Open> AtByFields(std::span<const Eigen::Vector3d> points_m, std::span<const std::uint32_t> order,
                               std::span<SurfaceDistance> answers) const;
  bool TryField(const Eigen::Vector3d& p_map, const FieldCell& cell, const Eigen::Vector3f& p,
                const NearField::List& list, SurfaceDistance& answer, double& within_m) const;
  void Tell(const Eigen::Vector3d& p_map, const NearestSurface& found, const Way& way, double padding_m,
            SurfaceDistance& answer, double& side) const;
  [[nodiscard]] SurfaceDistance Describe(const Eigen::Vector3d& p_map, double limit_m, const NearestSurface& found,
                                         double padding_m) const;

  QueryWorld world_;
  DistanceOptions options_;
  bool takes_fields_;
};

}  // namespace dhpmap

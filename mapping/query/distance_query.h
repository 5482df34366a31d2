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
  kUnknown,  ///< the distance is valid, but the point itself is in unseen space
};

/// Distance of a point to the nearest surface of the map.
struct SurfaceDistance {
  DistanceStatus status = DistanceStatus::kClamped;
  /// Euclidean, minus the submap's padding. Negative behind a surface: within the submap's truncation band, and deeper
  /// unless sensors saw the point free or in front of a surface. Beyond the border of a surface (it ends at the nearest
  /// point), negative only if the point's own voxel was observed behind it. Also negative at unseen points inside a
  /// thing, whichever surface is nearest: see thing_inside.h. If clamped: the limit.
  double distance_m = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< gradient of the distance, map frame, unit; zero if clamped
  Eigen::Vector3d nearest_m;                           ///< on the surface, map frame; NaN if clamped
  const SubmapInfo* submap = nullptr;  ///< owner of the surface; null if clamped. Valid as long as the surfaces
};

struct DistanceOptions {
  double max_distance_m = 3;     ///< finite, positive
  bool unknown_is_free = false;  ///< unseen points are OK, not UNKNOWN
  /// Allowed overestimate of a distance, in voxels of the map. From NearField::kTolerance_vox on, and with the same
  /// padding for all surfaces, near fields answer where they exist, several times as fast; otherwise exact.
  double tolerance_vox = 0;
  QueryScope scope;
};

/// Distances of an ESDF, computed without a grid: to the zero surfaces of all submaps in a state of a map
/// (ExtractTileSurface), each at its pose and grown by its padding. Exact to 1e-5 of the distance and 1e-4 voxels, by
/// rounding. With a tolerance, |distance + padding| is never underestimated, and overestimated by at most
/// NearField::kTolerance_vox voxels and a fraction of NearField::kShare; nearest point, gradient and submap are those
/// of such a surface point. Within() and AnyCloserThan() are always exact. Immutable, thread-safe.
class DistanceQuery {
 public:
  DistanceQuery(std::shared_ptr<const MapSurfaces> surfaces, DistanceOptions options);

  /// `p_map`: finite, metres of the map frame.
  [[nodiscard]] SurfaceDistance At(const Eigen::Vector3d& p_map) const;

  /// The same, exactly, with its own finite limit; negative only if a surface is grown by as much.
  [[nodiscard]] SurfaceDistance Within(const Eigen::Vector3d& p_map, double limit_m) const;

  /// The same for many points, with answers in their order. Faster, because it visits them along a space-filling curve.
  /// Both spans have the same length.
  void At(std::span<const Eigen::Vector3d> points_m, std::span<SurfaceDistance> answers) const;
  /// The same for points that are sorted already so that consecutive ones are close: see OrderAlongCurve.
  void AtInOrder(std::span<const Eigen::Vector3d> points_m, std::span<SurfaceDistance> answers) const;

  /// Whether any grown surface is within `radius_m` (finite, not negative) of a point, on either side. Stops as soon as
  /// it is decided; constant time far from surfaces. May include surfaces farther by 1e-5 of the radius.
  [[nodiscard]] bool AnyCloserThan(const Eigen::Vector3d& p_map, double radius_m) const;

 private:
  class Searches;
  class Limit;
  void AtOrdered(std::span<const Eigen::Vector3d> points_m, std::vector<std::uint32_t> order,
                 std::span<SurfaceDistance> answers) const;
  /// Vector from a surface, whose normal may have any length, to a point.
  struct Way {
    Eigen::Vector3d normal, away_m;
    /// Perpendicular to the front, within a degree.
    [[nodiscard]] bool IsAcross() const {
      constexpr double kCosine = 0.9998;
      return normal.dot(away_m) >= kCosine * normal.norm() * away_m.norm();
    }
  };
  /// A point that is not searched yet, with a known upper bound of its distance, if any.
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

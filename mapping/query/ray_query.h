// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mapping/query/query_scope.h"
#include "mapping/query/query_world.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// Map frame; the direction is of unit length.
struct Ray {
  Eigen::Vector3d origin_m, direction;
};

/// What a ray meets first, and how far it goes through what is known.
struct RayHit {
  const SubmapInfo* submap = nullptr;  ///< whose surface it meets; null: none within the limit. Valid as the surfaces
  double distance_m = 0;               ///< from the origin; the limit, if it meets nothing
  Eigen::Vector3d point_m;             ///< NaN if it meets nothing
  Eigen::Vector3d normal;              ///< of the surface, unit, to its front; NaN if it meets nothing
  bool is_unknown = false;             ///< before that it enters space that nobody has seen
  double free_m = 0;                   ///< so far it goes until it meets something or enters the unseen
};

struct RayOptions {
  double max_distance_m = 3;     ///< finite, positive
  bool unknown_is_free = false;  ///< unseen space is passed like any other
  QueryScope scope;              ///< padding has no meaning here
};

/// Whether a ray meets the surface of one submap within a finite limit.
bool MeetsSubmap(const MapSurfaces& surfaces, std::size_t number, const Ray& ray, double limit_m);

/// Rays through a state of a map, to the same surfaces that distances are measured to, seen from either side.
/// Immutable, thread-safe.
class RayQuery {
 public:
  RayQuery(std::shared_ptr<const MapSurfaces> surfaces, RayOptions options);

  /// `ray`: finite.
  [[nodiscard]] RayHit Cast(const Ray& ray) const;

 private:
  [[nodiscard]] RayHit FirstHit(const Ray& ray) const;
  /// How far the ray goes through voxels of the map's grid that somebody has seen, up to `end_m`.
  [[nodiscard]] double SeenUpTo(const Ray& ray, double end_m) const;

  QueryWorld world_;
  RayOptions options_;
};

}  // namespace dhpmap

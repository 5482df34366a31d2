// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mapping/query/query_scope.h"
#include "mapping/query/query_world.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// Map frame; unit direction.
struct Ray {
  Eigen::Vector3d origin_m, direction;
};

/// First hit of a ray, and the length of its known part.
struct RayHit {
  const SubmapInfo* submap =
      nullptr;              ///< owner of the surface; null: no hit within the limit. Valid as long as the surfaces
  double distance_m = 0;    ///< from the origin; the limit without a hit
  Eigen::Vector3d point_m;  ///< NaN without a hit
  Eigen::Vector3d normal;   ///< of the surface, unit, to its front; NaN without a hit
  bool is_unknown = false;  ///< the ray enters unseen space before the hit
  double free_m = 0;        ///< length up to the hit or to unseen space
};

struct RayOptions {
  double max_distance_m = 3;     ///< finite, positive
  bool unknown_is_free = false;  ///< unseen space does not end free_m
  QueryScope scope;              ///< padding is ignored
};

/// Whether a ray meets the surface of one submap within a finite limit.
bool MeetsSubmap(const MapSurfaces& surfaces, std::size_t number, const Ray& ray, double limit_m);

/// Ray casts in a state of a map, against both sides of the surfaces that distances refer to. Immutable, thread-safe.
class RayQuery {
 public:
  RayQuery(std::shared_ptr<const MapSurfaces> surfaces, RayOptions options);

  /// `ray`: finite.
  [[nodiscard]] RayHit Cast(const Ray& ray) const;

 private:
  [[nodiscard]] RayHit FirstHit(const Ray& ray) const;
  /// Length of the ray through observed voxels of the map's grid, up to `end_m`.
  [[nodiscard]] double SeenUpTo(const Ray& ray, double end_m) const;

  QueryWorld world_;
  RayOptions options_;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <compare>
#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/query/query_scope.h"
#include "mapping/submap/bounding_sphere.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

/// Position of a match in the order, for paging.
struct MatchPlace {
  double distance_m = 0;  ///< from near_m; 0 without it
  SubmapId id;
  auto operator<=>(const MatchPlace&) const = default;
};

/// A filter of submaps: all given conditions must hold. Positions are in the query's frame. A filter by class finds
/// objects, not obstacles, so it never matches the unknown submap, which remains an obstacle of other queries.
struct SubmapQuestion {
  Transform T_map_query = Transform::Identity();  ///< transform of the query's frame
  QueryScope scope;
  std::string name_part;                     ///< part of the display name, ignoring ASCII case
  std::optional<Eigen::AlignedBox3d> box_m;  ///< some of its surface is inside
  std::optional<BoundingSphere> sphere_m;    ///< likewise
  std::optional<Eigen::Vector3d> near_m;     ///< order by distance to it, else by id
  std::optional<double> max_distance_m;      ///< from near_m
  std::optional<MatchPlace> after;           ///< only matches after this position
  std::size_t most = 100;                    ///< limit
};

struct SubmapMatch {
  const Submap* submap = nullptr;
  double distance_m = 0;      ///< from near_m to its surface; 0 without it
  Eigen::Vector3d nearest_m;  ///< on its surface; NaN without near_m
  Eigen::AlignedBox3d box_m;  ///< axis-aligned box around its surface, in the query's frame
};

/// Examines only submaps whose boxes may be among the nearest. Computes missing surfaces. Returns partial results soon
/// after a `stop` request. References are valid as long as the surfaces.
std::vector<SubmapMatch> SearchSubmaps(const MapSurfaces& surfaces, const SubmapQuestion& question,
                                       const std::stop_token& stop = {});

}  // namespace dhpmap

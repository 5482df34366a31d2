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

/// Where a submap stands among what was found.
struct MatchPlace {
  double distance_m = 0;  ///< from near_m; 0 without that
  SubmapId id;
  auto operator<=>(const MatchPlace&) const = default;
};

/// Which submaps: those that pass all that is given. Places are in the asker's frame. Who asks for classes looks for
/// things of these, not for obstacles: the unknown submap, which stays in the way of other queries, is none.
struct SubmapQuestion {
  Transform T_map_query = Transform::Identity();  ///< from the asker's frame
  QueryScope scope;
  std::string name_part;                     ///< of the display name, in any case of ASCII letters
  std::optional<Eigen::AlignedBox3d> box_m;  ///< some of the surface is in it
  std::optional<BoundingSphere> sphere_m;    ///< likewise
  std::optional<Eigen::Vector3d> near_m;     ///< the nearest to it come first, else those of least id
  std::optional<double> max_distance_m;      ///< from there
  std::optional<MatchPlace> after;           ///< only those that come after it
  std::size_t most = 100;                    ///< so many at most
};

struct SubmapMatch {
  const Submap* submap = nullptr;
  double distance_m = 0;      ///< from near_m to its surface; 0 without that
  Eigen::Vector3d nearest_m;  ///< on its surface; NaN without
  Eigen::AlignedBox3d box_m;  ///< around its surface, along the axes of the asker's frame
};

/// Looks only into submaps whose boxes say that they may be among the nearest. Makes surfaces that are not there.
/// Gives up, with what it has, soon after `stop` is requested. What it refers to lasts as long as the surfaces.
std::vector<SubmapMatch> SearchSubmaps(const MapSurfaces& surfaces, const SubmapQuestion& question,
                                       const std::stop_token& stop = {});

}  // namespace dhpmap

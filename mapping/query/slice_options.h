// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "mapping/base/transform.h"
#include "mapping/query/query_scope.h"

namespace dhpmap {

/// Values of a cell, as in nav_msgs/OccupancyGrid.
inline constexpr std::int8_t kFreeCell = 0, kOccupiedCell = 100, kUnknownCell = -1;

/// A height band, seen from above in the query's frame, whose z is up.
struct SliceOptions {
  Transform T_map_query = Transform::Identity();
  double min_z_m = 0, max_z_m = 0;                  ///< finite, min < max
  double resolution_m = 0;                          ///< side of a cell; finite, positive
  Eigen::Vector2d min_m = Eigen::Vector2d::Zero();  ///< corner of cell (0, 0)
  int width = 0, height = 0;                        ///< cells along x and y
  double free_share = 0.3;                          ///< within 0 and 1
  std::int8_t unknown = kUnknownCell;               ///< value of unseen cells: unknown, free or occupied
  double max_distance_m = 3;                        ///< unseen space up to this far behind a surface may be inside
  bool with_objects = false;
  QueryScope scope;
};

}  // namespace dhpmap

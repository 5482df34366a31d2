// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/transform.h"

namespace dhpmap {

/// Where a submap's surface differs between two states of a map, tile by tile.
struct SurfaceChange {
  SubmapId submap;
  /// It was there in the earlier state, and is no longer as it was; else it is there in the later one, and was not.
  bool is_gone = false;
  Transform T_submap_map = Transform::Identity();  ///< in that state
  std::vector<Eigen::AlignedBox3d> boxes_m;        ///< around the surface of each tile, in the submap's frame
  Eigen::AlignedBox3d around_m;                    ///< all of them
};

}  // namespace dhpmap

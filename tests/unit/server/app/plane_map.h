// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "mapping/map/map.h"
#include "tests/unit/mapping/mesh/solid_submap.h"

namespace dhpmap::testing {

/// A plane at z = 0.2 in one block of submap 1, facing up.
inline std::shared_ptr<const MapSnapshot> PlaneMap() {
  Submap submap = SolidSubmap([](const Eigen::Vector3d& p) { return p.z() - 0.2; }, {0, 0, 0}, {0, 0, 0});
  submap.mutable_info().id = SubmapId(1);
  submap.UpdateBoundingSphere();
  MapInfo info;
  info.config.voxel_size_m = kVoxel_m;
  return std::make_shared<const MapSnapshot>(
      info, std::vector<std::shared_ptr<const Submap>>{std::make_shared<const Submap>(std::move(submap))});
}

}  // namespace dhpmap::testing

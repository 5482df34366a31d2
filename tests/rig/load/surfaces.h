// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <array>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "dhpmap/v1/types.pb.h"

namespace dhpmap::rig {

/// A thing of a map, and which voxels of the map's grid its surface goes through.
struct ThingSurface {
  v1::Submap submap;
  std::set<std::array<std::int32_t, 3>> voxels;  ///< in units of the submap's voxel size
};

/// What a map holds.
struct MapSurfaces {
  std::vector<ThingSurface> things;                              ///< that are present
  std::int64_t num_observed_voxels = 0, num_surface_voxels = 0;  ///< of all submaps
};

/// Reads all submaps of maps/{map_id} and their voxels.
grpc::Status ReadSurfaces(const std::shared_ptr<grpc::Channel>& channel, const std::string& map_id, MapSurfaces& map);

/// Of one class, and at least half of the surface of the smaller one is surface of the other.
bool AreCounterparts(const ThingSurface& a, const ThingSurface& b);

}  // namespace dhpmap::rig

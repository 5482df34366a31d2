// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "mapping/base/grid.h"

namespace dhpmap {

/// The sensor's position on the map's grid, split into voxel and offset, so that single precision suffices near the
/// sensor anywhere in the map.
struct GridOrigin {
  VoxelIndex voxel;            ///< contains the sensor
  Eigen::Vector3d offset_vox;  ///< within that voxel

  GridOrigin(const Eigen::Vector3d& p_map_m, double voxel_size_m)
      : voxel(VoxelAt(p_map_m, voxel_size_m)),
        offset_vox(p_map_m / voxel_size_m - Eigen::Vector3d(voxel.x, voxel.y, voxel.z)) {}

  /// From the sensor to the centre of the cube of `side` voxels with number `index`, along one axis.
  static float ToCentre(std::int32_t index, int side, std::int32_t origin, double offset_vox) {
    const auto first = static_cast<double>(std::int64_t{index} * side - origin);
    return static_cast<float>(first + 0.5 * side - offset_vox);
  }
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/base/thread_pool.h"
#include "mapping/base/transform.h"
#include "mapping/fusion/frame_tally.h"
#include "mapping/fusion/point_kernel.h"
#include "mapping/fusion/point_run.h"
#include "mapping/map/map_config.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// The runs of a frame by band, in the order of their first points. Bands do not depend on the number of threads.
using RunBands = std::vector<std::vector<PointRun>>;

/// The sensor on the grid: its axes, and its origin as a voxel and an offset, so that single precision resolves a
/// millimetre at any distance from the map's origin.
struct SensorOnGrid {
  Eigen::Matrix3f R_grid_sensor;
  float voxels_per_m;
  VoxelIndex base;
  Eigen::Vector3f offset_vox;

  SensorOnGrid(const Transform& T_grid_sensor, double voxel_size_m)
      : R_grid_sensor(T_grid_sensor.linear().cast<float>()), voxels_per_m(static_cast<float>(1.0 / voxel_size_m)) {
    base = VoxelAt(T_grid_sensor.translation(), voxel_size_m);
    offset_vox = (T_grid_sensor.translation() / voxel_size_m - Eigen::Vector3d(base.x, base.y, base.z)).cast<float>();
  }

  [[nodiscard]] VoxelIndex VoxelOf(const Eigen::Vector3f& p_m) const {
    const Eigen::Vector3f v = p_m * voxels_per_m + offset_vox;
    return {base.x + static_cast<std::int32_t>(std::floor(v.x())),
            base.y + static_cast<std::int32_t>(std::floor(v.y())),
            base.z + static_cast<std::int32_t>(std::floor(v.z()))};
  }
};

/// Projects every valid point in range onto the grid, and sums up the points of a band in the same voxel and segment,
/// nearly always in one run. Writes all bands and reuses their memory. If the frame turns out to be too large, some
/// bands may be empty.
void CollectCameraRuns(const DepthCameraData& data, const SensorOnGrid& grid, const IntegrationConfig& config,
                       ThreadPool& pool, FrameTally& tally, RunBands& bands);
void CollectLidarRuns(const LidarData& data, const SensorOnGrid& grid, const IntegrationConfig& config,
                      ThreadPool& pool, FrameTally& tally, RunBands& bands);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/map_fit.h"

#include <algorithm>
#include <cmath>

#include "mapping/base/grid_reach.h"
#include "mapping/plausibility/nearest_voxels.h"

namespace dhpmap {
namespace {

/// Noise of a depth camera and of its poses stays within it.
constexpr double kAgreeing_vox = 1.5;
/// So far behind its front, a surface was met. Half a band of the least width is met with steps of this length.
constexpr double kBehind_vox = 0.5, kStep_vox = 1.5;
/// Rays are walked for few points only.
constexpr std::size_t kNumRays = 40;

bool IsOnGrid(const Transform& T_map_sensor, const Map& map) {
  return WhyBeyondGrid(T_map_sensor.translation(), map.info().config.voxel_size_m).empty();
}

/// From the sensor to two bands before the point, which may be on a surface itself.
std::vector<Eigen::Vector3d> StepsTo(const Eigen::Vector3d& p_m, const Transform& T_map_sensor, const Map& map) {
  const MapConfig& config = map.info().config;
  const double range_m = p_m.norm(), end_m = range_m - 2 * config.truncation_m;
  std::vector<Eigen::Vector3d> steps_m;
  for (double at_m = config.integration.min_range_m; at_m < end_m; at_m += kStep_vox * config.voxel_size_m) {
    steps_m.push_back(T_map_sensor * (p_m * (at_m / range_m)));
  }
  return steps_m;
}

bool GoesThroughASurface(std::span<const Eigen::Vector3d> steps_map_m, const Map& map) {
  const auto behind_m = static_cast<float>(-kBehind_vox * map.info().config.voxel_size_m);
  const auto voxels = FindNearestVoxels(steps_map_m, map);
  return std::any_of(voxels.begin(), voxels.end(), [behind_m](const NearestVoxel& voxel) {
    return voxel.IsInBand() && voxel.DistanceOfPoint() < behind_m;
  });
}

}  // namespace

MapFit FitToMap(std::span<const Eigen::Vector3f> points_m, const Transform& T_map_sensor, const Map& map) {
  MapFit fit;
  fit.num_points = points_m.size();
  if (!IsOnGrid(T_map_sensor, map)) return fit;
  std::vector<Eigen::Vector3d> points_map_m;
  points_map_m.reserve(points_m.size());
  for (const Eigen::Vector3f& p : points_m) points_map_m.push_back(T_map_sensor * p.cast<double>());
  const auto voxels = FindNearestVoxels(points_map_m, map);
  const double voxel_size_m = map.info().config.voxel_size_m;
  const auto agreeing_m = static_cast<float>(kAgreeing_vox * voxel_size_m);
  for (std::size_t i = 0; i < points_map_m.size(); ++i) {
    if (voxels[i].IsInBand()) {
      const float residual_m = std::abs(voxels[i].DistanceOfPoint());
      fit.residuals_m.push_back(residual_m);
      ++(residual_m <= agreeing_m ? fit.num_agreeing : fit.num_contradicted);
    } else if (map.free_space().IsFree(VoxelAt(points_map_m[i], voxel_size_m))) {
      ++fit.num_contradicted;
    }
  }
  return fit;
}

double SeenThroughFraction(std::span<const Eigen::Vector3f> points_m, const Transform& T_map_sensor, const Map& map) {
  if (!IsOnGrid(T_map_sensor, map)) return 0;
  const std::size_t step = std::max<std::size_t>(1, points_m.size() / kNumRays);
  std::size_t num_rays = 0, num_through = 0;
  for (std::size_t i = step / 2; i < points_m.size(); i += step) {
    ++num_rays;
    num_through += GoesThroughASurface(StepsTo(points_m[i].cast<double>(), T_map_sensor, map), map) ? 1 : 0;
  }
  return Share(num_through, num_rays);
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/reference_integrator.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dhpmap::testing {
namespace {

struct Bundle {
  Eigen::Vector3d weighted_sum = Eigen::Vector3d::Zero();
  double weight = 0;
};

double Weight(const Eigen::Vector3d& p_sensor, Weighting weighting) {
  if (weighting == Weighting::kInverseDepthSquared) return 1.0 / (p_sensor.z() * p_sensor.z());
  if (weighting == Weighting::kInverseRangeSquared) return 1.0 / p_sensor.squaredNorm();
  return 1.0;
}

/// Length of the segment a-b inside the voxel (slab test).
double LengthInside(const Eigen::Vector3d& a, const Eigen::Vector3d& b, VoxelIndex v, double size) {
  double from = 0, to = 1;
  const double low[3] = {v.x * size, v.y * size, v.z * size};
  for (int i = 0; i < 3; ++i) {
    const double d = b[i] - a[i];
    if (d == 0) {
      if (a[i] < low[i] || a[i] > low[i] + size) return 0;
      continue;
    }
    const double t0 = (low[i] - a[i]) / d, t1 = (low[i] + size - a[i]) / d;
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  return std::max(0.0, to - from) * (b - a).norm();
}

}  // namespace

void IntegrateSlowly(const PanopticFrame& frame, const MapConfig& config, const PlaneOfVoxel& planes,
                     ReferenceMap& map) {
  const double size = config.voxel_size_m, tau = config.truncation_m;
  const Eigen::Vector3d origin = frame.T_map_sensor.translation();
  const PinholeCamera& camera = frame.camera->camera;
  std::map<VoxelIndex, Bundle> bundles;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const double depth = frame.camera->depth_m[static_cast<std::size_t>(v * camera.width_px + u)];
      if (!(depth > 0)) continue;
      const Eigen::Vector3d p_sensor((u - camera.cx_px) / camera.fx_px * depth,
                                     (v - camera.cy_px) / camera.fy_px * depth, depth);
      if (p_sensor.norm() < config.integration.min_range_m || p_sensor.norm() > config.integration.max_range_m)
        continue;
      const Eigen::Vector3d p_map = frame.T_map_sensor * p_sensor;
      const double weight = Weight(p_sensor, config.integration.weighting);
      Bundle& bundle = bundles[VoxelAt(p_map, size)];
      bundle.weighted_sum += weight * p_map;
      bundle.weight += weight;
    }
  }
  for (const auto& [end_voxel, bundle] : bundles) {
    const Eigen::Vector3d end = bundle.weighted_sum / bundle.weight;
    const double range = (end - origin).norm();
    const Eigen::Vector3d direction = (end - origin) / range;
    const TangentPlane& plane = planes.at(end_voxel);
    const Eigen::Vector3d a = origin + std::max(0.0, range - tau) * direction, b = origin + (range + tau) * direction;
    const VoxelIndex low = VoxelAt(a.cwiseMin(b), size), high = VoxelAt(a.cwiseMax(b), size);
    for (int x = low.x; x <= high.x; ++x) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int z = low.z; z <= high.z; ++z) {
          const VoxelIndex voxel{x, y, z};
          if (LengthInside(a, b, voxel, size) <= 1e-4 * size) continue;  // a mere touch: rounding decides
          if (voxel != end_voxel && bundles.count(voxel) > 0) continue;
          const Eigen::Vector3d centre = VoxelCentre(voxel, size) - origin;
          if (direction.dot(centre) >= range + tau) continue;  // beyond the band's end
          const double sdf = plane.normal.cast<double>().dot(centre) + plane.offset_m;
          double weight = bundle.weight;
          if (config.integration.weight_dropoff && sdf < -size) weight *= (tau + sdf) / (tau - size);
          if (weight <= 0) continue;
          ReferenceVoxel& stored = map[voxel];
          const double sum = stored.weight + weight;
          stored.distance_m = (stored.distance_m * stored.weight + std::clamp(sdf, -tau, tau) * weight) / sum;
          stored.weight = std::min(sum, config.integration.max_weight);
          if (range - centre.dot(direction) > -tau) ++stored.num_observations;
        }
      }
    }
  }
}

}  // namespace dhpmap::testing

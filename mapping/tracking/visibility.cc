// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/visibility.h"

#include <cmath>

namespace dhpmap {

bool MayBeInView(const PanopticFrame& frame, double max_range_m, const BoundingSphere& sphere) {
  if (sphere.IsEmpty()) return false;
  const Eigen::Vector3d p = frame.T_map_sensor.inverse() * sphere.center_m;
  if (p.norm() > max_range_m + sphere.radius_m) return false;
  if (!frame.camera) return true;
  if (p.z() < -sphere.radius_m) return false;
  const PinholeCamera& camera = frame.camera->camera;
  // Inward normals of the four planes through the sensor and the borders of the image.
  const Eigen::Vector3d borders[] = {
      {camera.fx_px, 0, camera.cx_px},
      {-camera.fx_px, 0, camera.width_px - camera.cx_px},
      {0, camera.fy_px, camera.cy_px},
      {0, -camera.fy_px, camera.height_px - camera.cy_px},
  };
  for (const Eigen::Vector3d& normal : borders) {
    if (p.dot(normal.normalized()) < -sphere.radius_m) return false;
  }
  return true;
}

bool ShouldBeSeen(const PanopticFrame& frame, double max_range_m, const BoundingSphere& sphere) {
  if (sphere.IsEmpty()) return false;
  const Eigen::Vector3d p = frame.T_map_sensor.inverse() * sphere.center_m;
  if (p.norm() > max_range_m) return false;
  if (!frame.camera) return true;
  const PinholeCamera& camera = frame.camera->camera;
  if (p.z() <= 0) return false;
  const auto u = static_cast<int>(std::lround(camera.fx_px * p.x() / p.z() + camera.cx_px));
  const auto v = static_cast<int>(std::lround(camera.fy_px * p.y() / p.z() + camera.cy_px));
  if (u < 0 || v < 0 || u >= camera.width_px || v >= camera.height_px) return false;
  const float depth_m = frame.camera->depth_m[static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width_px) +
                                              static_cast<std::size_t>(u)];
  return std::isfinite(depth_m) && depth_m > 0 && depth_m >= p.z() - sphere.radius_m;
}

}  // namespace dhpmap

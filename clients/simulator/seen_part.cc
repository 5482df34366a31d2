// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/seen_part.h"

#include <algorithm>
#include <utility>

namespace dhpmap::simulator {

void SeenPart::Join(const SeenPart& other) {
  if (other.IsEmpty()) return;
  std::vector<Eigen::Vector2d> corners = std::move(outline_m);
  corners.insert(corners.end(), other.outline_m.begin(), other.outline_m.end());
  outline_m = ConvexHull(std::move(corners));
  low_m = std::min(low_m, other.low_m);
  high_m = std::max(high_m, other.high_m);
}

std::vector<SeenPart> SeenParts(const RenderedFrame& frame, std::size_t num_instances) {
  std::vector<SeenPart> parts(num_instances);
  std::vector<std::vector<Eigen::Vector2d>> points(num_instances);
  const PinholeCamera& camera = frame.camera;
  std::size_t i = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u, ++i) {
      const std::size_t id = frame.instances[i];
      const double z = frame.depth_m[i];
      if (id == 0 || z <= 0) continue;
      const Eigen::Vector3d looking((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
      const Eigen::Vector3d p_m = frame.T_map_camera * (z * looking);
      points[id].push_back(p_m.head<2>());
      parts[id].low_m = std::min(parts[id].low_m, p_m.z());
      parts[id].high_m = std::max(parts[id].high_m, p_m.z());
    }
  }
  for (std::size_t id = 0; id < num_instances; ++id) parts[id].outline_m = ConvexHull(std::move(points[id]));
  return parts;
}

}  // namespace dhpmap::simulator

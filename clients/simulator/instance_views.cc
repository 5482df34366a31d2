// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/instance_views.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dhpmap::simulator {
namespace {

// Range of good depth with dense pixels.
constexpr float kNear_m = 0.5f, kDistant_m = 4.0f;
constexpr float kJump = 0.04f;  ///< relative to depth

/// Chebyshev distance in pixels from each pixel to the nearest one of another instance, behind a depth jump, or
/// outside.
std::vector<int> Margins(const RenderedFrame& frame) {
  const int width = frame.camera.width_px, height = frame.camera.height_px;
  std::vector<int> margins(frame.instances.size(), 0);
  const auto index = [width](int u, int v) { return static_cast<std::size_t>(v * width + u); };
  const auto through = [&](std::size_t here, std::size_t there) {
    const bool is_same = frame.instances[here] == frame.instances[there] &&
                         std::abs(frame.depth_m[here] - frame.depth_m[there]) < kJump * frame.depth_m[here];
    return is_same ? margins[there] + 1 : 1;
  };
  for (int v = 1; v + 1 < height; ++v) {
    for (int u = 1; u + 1 < width; ++u) {
      const std::size_t i = index(u, v);
      margins[i] = std::min({through(i, index(u - 1, v)), through(i, index(u - 1, v - 1)), through(i, index(u, v - 1)),
                             through(i, index(u + 1, v - 1))});
    }
  }
  for (int v = height - 2; v > 0; --v) {
    for (int u = width - 2; u > 0; --u) {
      const std::size_t i = index(u, v);
      margins[i] = std::min({margins[i], through(i, index(u + 1, v)), through(i, index(u + 1, v + 1)),
                             through(i, index(u, v + 1)), through(i, index(u - 1, v + 1))});
    }
  }
  return margins;
}

}  // namespace

void InstanceView::Join(const InstanceView& other) {
  num_pixels = std::max(num_pixels, other.num_pixels);
  num_frames += other.num_frames;
  seen.Join(other.seen);
  if (other.margin_px <= margin_px) return;
  margin_px = other.margin_px;
  point_m = other.point_m;
}

std::vector<InstanceView> ViewsOfInstances(const RenderedFrame& frame, std::size_t num_instances) {
  std::vector<InstanceView> views(num_instances);
  const std::vector<int> margins = Margins(frame);
  const PinholeCamera& camera = frame.camera;
  std::size_t i = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u, ++i) {
      InstanceView& view = views[frame.instances[i]];
      ++view.num_pixels;
      const float z = frame.depth_m[i];
      if (margins[i] <= view.margin_px || z < kNear_m || z > kDistant_m) continue;
      view.margin_px = margins[i];
      const Eigen::Vector3d looking((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
      view.point_m = frame.T_map_camera * (static_cast<double>(z) * looking);
    }
  }
  std::vector<SeenPart> parts = SeenParts(frame, num_instances);
  for (std::size_t id = 0; id < num_instances; ++id) views[id].seen = std::move(parts[id]);
  const double scale = camera.width_px / 640.0;
  for (InstanceView& view : views) view.num_frames = view.num_pixels >= kSeen_px * scale * scale ? 1 : 0;
  return views;
}

}  // namespace dhpmap::simulator

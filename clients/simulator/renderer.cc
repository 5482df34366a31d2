// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/renderer.h"

#include "clients/simulator/beam_grid.h"
#include "clients/simulator/picture.h"

namespace dhpmap::simulator {

PinholeCamera FlatLayoutCamera(int width_px, int height_px) {
  return {.width_px = width_px,
          .height_px = height_px,
          .fx_px = width_px / 2.0,
          .fy_px = width_px / 2.0,
          .cx_px = width_px / 2.0,
          .cy_px = height_px / 2.0};
}

Renderer::Renderer(const ApartmentScene& scene, Output output) : scene_(scene) {
  if (output == Output::kGeometryAndColor) shader_.emplace(scene);
}

RenderedFrame Renderer::Render(const PinholeCamera& camera, const Transform& T_map_camera) const {
  RenderedFrame frame{.camera = camera, .T_map_camera = T_map_camera};
  const auto num_pixels = static_cast<std::size_t>(camera.num_pixels());
  frame.depth_m.assign(num_pixels, 0);
  frame.instances.assign(num_pixels, 0);
  std::vector<ApartmentScene::Hit> hits(shader_ ? num_pixels : 0);
  const BeamGrid beams(scene_.tree(), camera, T_map_camera);
  const Eigen::Vector3d forward = T_map_camera.linear().col(2);
  std::size_t i = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u, ++i) {
      const Ray ray = PixelRay(frame, u, v);
      const ApartmentScene::Hit hit = beams.Cast(u, v, ray);
      if (hit.solid != nullptr) {
        frame.depth_m[i] = static_cast<float>(hit.distance_m * forward.dot(ray.direction));
        frame.instances[i] = hit.solid->instance;
      }
      if (shader_) hits[i] = hit;
    }
  }
  if (shader_) frame.color = Picture(*shader_, frame, beams, hits).Colors();
  return frame;
}

}  // namespace dhpmap::simulator

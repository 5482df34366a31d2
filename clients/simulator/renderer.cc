// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/renderer.h"

#include <array>
#include <cmath>

namespace dhpmap::simulator {
namespace {

const Light kNothing(0.9f, 0.9f, 0.9f);

Ray PixelRay(const RenderedFrame& frame, double u, double v) {
  return {frame.T_map_camera.translation(), frame.T_map_camera.linear() * PixelDirection(frame.camera, u, v)};
}

}  // namespace

Eigen::Vector3d PixelDirection(const PinholeCamera& camera, double u_px, double v_px) {
  return Eigen::Vector3d((u_px - camera.cx_px) / camera.fx_px, (v_px - camera.cy_px) / camera.fy_px, 1).normalized();
}

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
  std::vector<Surface> surfaces(shader_ ? num_pixels : 0);
  const Eigen::Vector3d forward = T_map_camera.linear().col(2);
  std::size_t i = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u, ++i) {
      const Ray ray = PixelRay(frame, u, v);
      const std::optional<ApartmentScene::Hit> hit = scene_.Cast(ray);
      if (hit) {
        frame.depth_m[i] = static_cast<float>(hit->distance_m * forward.dot(ray.direction));
        frame.instances[i] = hit->solid->instance;
      }
      if (!shader_) continue;
      surfaces[i].light = hit ? Look(ray, *hit, camera.fx_px) : kNothing;
      if (hit) surfaces[i].solid = hit->solid;
    }
  }
  if (shader_) SmoothEdges(surfaces, frame);
  return frame;
}

Light Renderer::Look(const Ray& ray, const ApartmentScene::Hit& hit, double focal_px) const {
  // Between the short and the long side of a pixel on a slanted surface.
  const double cosine = std::abs(hit.solid->Normal(ray.At(hit.distance_m)).dot(ray.direction));
  return shader_->Shade(ray, hit, hit.distance_m / focal_px / std::sqrt(std::max(cosine, 0.05)));
}

Light Renderer::LookAround(const RenderedFrame& frame, int u, int v) const {
  constexpr std::array<std::array<double, 2>, 4> kRotatedGrid{
      {{-0.375, -0.125}, {0.125, -0.375}, {0.375, 0.125}, {-0.125, 0.375}}};
  Light sum = Light::Zero();
  for (const auto& [du, dv] : kRotatedGrid) {
    const Ray ray = PixelRay(frame, u + du, v + dv);
    const std::optional<ApartmentScene::Hit> hit = scene_.Cast(ray);
    // Clipped, so that a bright lamp does not outshine its smooth edge.
    sum += (hit ? Look(ray, *hit, frame.camera.fx_px) : kNothing).cwiseMin(1.5f);
  }
  return sum / static_cast<float>(kRotatedGrid.size());
}

void Renderer::SmoothEdges(const std::vector<Surface>& surfaces, RenderedFrame& frame) const {
  const int width = frame.camera.width_px, height = frame.camera.height_px;
  frame.color.resize(surfaces.size());
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const auto at = [&](int x, int y) -> const Surface& {
        return surfaces[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
      };
      const Surface& here = at(u, v);
      const auto differs = [&here](const Surface& other) {
        return other.solid != here.solid || (other.light - here.light).cwiseAbs().maxCoeff() > 0.12f;
      };
      const bool is_edge = (u > 0 && differs(at(u - 1, v))) || (u + 1 < width && differs(at(u + 1, v))) ||
                           (v > 0 && differs(at(u, v - 1))) || (v + 1 < height && differs(at(u, v + 1)));
      frame.color[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)] =
          Develop(is_edge ? LookAround(frame, u, v) : here.light);
    }
  }
}

}  // namespace dhpmap::simulator

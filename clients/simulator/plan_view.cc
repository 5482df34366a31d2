// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/plan_view.h"

#include <algorithm>
#include <cmath>

#include "clients/simulator/camera_path.h"

namespace dhpmap::simulator {
namespace {

const Eigen::Vector3d kEye_m(5.5, 0.6, 26.0);
const Eigen::Vector3d kLookAt_m(5.5, 4.2, 0.0);
constexpr double kVisibleWidth_m = 13.4;  ///< at floor level

Transform FromAbove() {
  const Eigen::Vector3d forward = (kLookAt_m - kEye_m).normalized(), right = Eigen::Vector3d::UnitX();
  Transform T_map_camera = Transform::Identity();
  T_map_camera.linear().col(0) = right;
  T_map_camera.linear().col(1) = forward.cross(right);
  T_map_camera.linear().col(2) = forward;
  T_map_camera.translation() = kEye_m;
  return T_map_camera;
}

void Blend(Rgb& pixel, const Rgb& over, double share) {
  const auto mix = [share](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
  };
  pixel = {mix(pixel.r, over.r), mix(pixel.g, over.g), mix(pixel.b, over.b)};
}

/// A line of soft discs; each pixel is covered by the nearest.
void DrawPath(const CameraPath& path, RenderedFrame& frame) {
  constexpr int kSamples = 4000;
  constexpr Rgb kOrange{244, 98, 32};
  const double radius = std::max(1.0, frame.camera.width_px / 500.0);
  const int width = frame.camera.width_px, height = frame.camera.height_px;
  std::vector<double> cover(frame.color.size(), 0);
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d p =
        frame.T_map_camera.inverse() * path.PoseAt(static_cast<double>(i) / kSamples).translation();
    const double u = frame.camera.fx_px * p.x() / p.z() + frame.camera.cx_px;
    const double v = frame.camera.fy_px * p.y() / p.z() + frame.camera.cy_px;
    for (int y = std::max(0, static_cast<int>(v - radius)); y <= std::min(height - 1, static_cast<int>(v + radius + 1));
         ++y) {
      for (int x = std::max(0, static_cast<int>(u - radius));
           x <= std::min(width - 1, static_cast<int>(u + radius + 1)); ++x) {
        double& here = cover[static_cast<std::size_t>(y * width + x)];
        here = std::max(here, std::clamp(radius + 0.5 - std::hypot(x - u, y - v), 0.0, 1.0));
      }
    }
  }
  for (std::size_t i = 0; i < cover.size(); ++i) Blend(frame.color[i], kOrange, 0.85 * cover[i]);
}

}  // namespace

RenderedFrame RenderPlan(int width_px) {
  const ApartmentScene scene(ApartmentScene::Ceiling::kOpen);
  const int height_px = std::max(1, width_px * 3 / 4);
  const double focal_px = width_px * (kLookAt_m - kEye_m).norm() / kVisibleWidth_m;
  const PinholeCamera camera{width_px, height_px, focal_px, focal_px, width_px / 2.0, height_px / 2.0};
  RenderedFrame frame = Renderer(scene).Render(camera, FromAbove());
  DrawPath(CameraPath(), frame);
  return frame;
}

}  // namespace dhpmap::simulator

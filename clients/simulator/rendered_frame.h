// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "clients/simulator/shading.h"
#include "mapping/base/transform.h"
#include "mapping/sensor/pinhole_camera.h"

namespace dhpmap::simulator {

/// Row-major images of one size, without noise.
struct RenderedFrame {
  PinholeCamera camera;
  Transform T_map_camera = Transform::Identity();  ///< camera: z forward, x right, y down
  std::vector<float> depth_m;                      ///< along the optical axis; 0: nothing
  std::vector<std::uint8_t> instances;             ///< ground-truth ids; 0: nothing
  std::vector<Rgb> color;                          ///< empty unless requested
};

/// Ray direction (unit, camera frame) of a pixel; integer coordinates are pixel centres.
Eigen::Vector3d PixelDirection(const PinholeCamera& camera, double u_px, double v_px);

}  // namespace dhpmap::simulator

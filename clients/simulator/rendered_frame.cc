// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/rendered_frame.h"

namespace dhpmap::simulator {

Eigen::Vector3d PixelDirection(const PinholeCamera& camera, double u_px, double v_px) {
  return Eigen::Vector3d((u_px - camera.cx_px) / camera.fx_px, (v_px - camera.cy_px) / camera.fy_px, 1).normalized();
}

}  // namespace dhpmap::simulator

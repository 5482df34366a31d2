// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap {

/// Where a point is in a camera's image, whether or not the camera sees it.
struct ProjectedPoint {
  float u_px = 0, v_px = 0;  ///< within the image
  float depth_m = 0;         ///< along the camera's axis, positive
};

}  // namespace dhpmap

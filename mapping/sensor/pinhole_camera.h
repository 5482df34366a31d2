// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/status.h"

namespace dhpmap {

/// Pinhole without distortion. Pixel (u, v) looks along ((u - cx) / fx, (v - cy) / fy, 1), u to the right, v down, with
/// integer coordinates at pixel centres.
struct PinholeCamera {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;

  [[nodiscard]] int num_pixels() const { return width_px * height_px; }
  /// Limit of a pixel's slope: beyond, points lie almost sideways and coordinates overflow.
  static constexpr double kMostSlope = 1e6;
  /// INVALID_ARGUMENT unless sizes are 1..16384, focal lengths positive, all values finite, and slopes of all pixels at
  /// most kMostSlope.
  [[nodiscard]] Status Validate() const;
};

}  // namespace dhpmap

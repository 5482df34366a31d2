// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/pinhole_camera.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dhpmap {

Status PinholeCamera::Validate() const {
  constexpr int kMaxSide_px = 16384;
  Status bad = InvalidArgument("the camera is not usable").WithReason("BAD_CAMERA");
  const auto check_size = [&bad](const char* field, int value) {
    if (value < 1 || value > kMaxSide_px) bad.AddViolation(field, std::to_string(value) + " is not within 1 and 16384");
  };
  const auto check_focal_length = [&bad](const char* field, double value) {
    if (!(value > 0) || !std::isfinite(value)) bad.AddViolation(field, std::to_string(value) + " is not positive");
  };
  const auto check_finite = [&bad](const char* field, double value) {
    if (!std::isfinite(value)) bad.AddViolation(field, std::to_string(value) + " is not finite");
  };
  check_size("width_px", width_px);
  check_size("height_px", height_px);
  check_focal_length("fx_px", fx_px);
  check_focal_length("fy_px", fy_px);
  check_finite("cx_px", cx_px);
  check_finite("cy_px", cy_px);
  const auto check_slope = [&bad](const char* field, double centre_px, int size_px, double focal_px) {
    const double aside_px = std::max(std::abs(centre_px), std::abs(size_px - 1 - centre_px));
    if (aside_px > kMostSlope * focal_px) {
      bad.AddViolation(field,
                       std::to_string(focal_px) + " is so short that pixels look more than 1e6 aside for 1 ahead");
    }
  };
  if (bad.violations().empty()) {
    check_slope("fx_px", cx_px, width_px, fx_px);
    check_slope("fy_px", cy_px, height_px, fy_px);
  }
  return bad.violations().empty() ? Status::Ok() : bad;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace dhpmap {

/// Change of a TSDF over one voxel along an axis, from a voxel's distance and those of its two neighbours, NaN if
/// unobserved. Central if both neighbours are observed, one-sided if one is, 0 if none is. In metres per voxel.
inline float Slope(float below_m, float here_m, float above_m) {
  if (!std::isnan(below_m) && !std::isnan(above_m)) return 0.5f * (above_m - below_m);
  if (!std::isnan(above_m)) return above_m - here_m;
  return std::isnan(below_m) ? 0.0f : here_m - below_m;
}

}  // namespace dhpmap

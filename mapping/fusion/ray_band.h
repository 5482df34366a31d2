// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// The part of a bundle's ray that is walked, from the sensor's origin: +-truncation about its end. Where it grazes its
/// plane it is longer, as far as the cells around the surface need it and the plane was seen; at most a block's side,
/// so that it stays in the blocks around its end.
struct RayBand {
  /// Across the surface: as far from it as the corners of the cells in which it lies, nearly. To walk on for all of the
  /// truncation made no better surfaces.
  static constexpr float kCellReach_vox = 1.5f;

  float from_m, to_m;
  RayBand(const TangentPlane& plane, const Eigen::Vector3f& direction, float range_m, float truncation_m,
          float voxel_size_m) {
    const float cosine = -plane.normal.dot(direction);
    const float wanted_m = std::min(truncation_m, kCellReach_vox * voxel_size_m) / cosine;
    from_m = std::max(range_m - std::max(truncation_m, std::min(wanted_m, plane.before_m)), 0.0f);
    to_m = range_m + std::max(truncation_m, std::min(wanted_m, plane.behind_m));
  }
};

}  // namespace dhpmap

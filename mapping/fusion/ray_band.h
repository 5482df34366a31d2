// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// The traversed part of a bundle's ray, measured from the sensor's origin: +-truncation around its end. A ray that
/// grazes its plane has a longer band, as far as the cells around the surface need it and the plane was seen. At most
/// one block's side, so that the band stays in the blocks around its end.
struct RayBand {
  /// Reach across the surface: nearly the distance of the farthest corner of a cell that contains it. The whole
  /// truncation gave no better surfaces.
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

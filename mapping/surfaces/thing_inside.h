// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

namespace dhpmap {

// Unseen space counts as the inside of a thing if it lies behind the thing's own surface, even beyond the surface's
// border, and within the box around that surface in the thing's own frame. The depth of a thing seen from one side
// only, such as a fridge between cupboards or a picture on a wall, is unknown. It is assumed to be the smaller of width
// and height, except at points straight in front of their nearest surface. Observations take precedence: space that was
// looked through or observed is not inside.

/// The box that may contain the inside of a thing, from the box around its surface: extended to the assumed depth on
/// either side.
inline Eigen::AlignedBox3d AsDeepAsWide(const Eigen::AlignedBox3d& surface_m) {
  if (surface_m.isEmpty()) return surface_m;
  const Eigen::Vector3d sizes_m = surface_m.sizes();
  Eigen::AlignedBox3d box = surface_m;
  for (int axis = 0; axis < 2; ++axis) {
    const double deeper_m = std::max(std::min(sizes_m[1 - axis], sizes_m.z()) - sizes_m[axis], 0.0);
    box.min()[axis] -= deeper_m;
    box.max()[axis] += deeper_m;
  }
  return box;
}

/// A box around it, for any surface within a box.
inline Eigen::AlignedBox3d MayBeInside(const Eigen::AlignedBox3d& around_m) {
  if (around_m.isEmpty()) return around_m;
  const Eigen::Vector3d sizes_m = around_m.sizes();
  const Eigen::Vector3d more_m(std::min(sizes_m.y(), sizes_m.z()), std::min(sizes_m.x(), sizes_m.z()), 0);
  return {around_m.min() - more_m, around_m.max() + more_m};
}

}  // namespace dhpmap

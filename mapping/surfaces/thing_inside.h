// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

namespace dhpmap {

// What nobody has seen is inside of a thing if it lies behind the thing's own surface, also where that ends at the
// nearest point, and within the box around its surface, in its own frame. Of a thing that was seen from one side only,
// such as a fridge between cupboards or a picture on a wall, nobody knows how deep it is: it is taken to be as deep as
// it is wide or high, whichever is less, but for places straight in front of what is nearest to them. Whatever else is
// known of a place goes first: what was looked through, or observed, is what it was seen to be.

/// The box in which the inside of a thing may lie, from the box around its surface: as deep as it is taken to be, to
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

/// Around that, of whatever surface is within a box.
inline Eigen::AlignedBox3d MayBeInside(const Eigen::AlignedBox3d& around_m) {
  if (around_m.isEmpty()) return around_m;
  const Eigen::Vector3d sizes_m = around_m.sizes();
  const Eigen::Vector3d more_m(std::min(sizes_m.y(), sizes_m.z()), std::min(sizes_m.x(), sizes_m.z()), 0);
  return {around_m.min() - more_m, around_m.max() + more_m};
}

}  // namespace dhpmap

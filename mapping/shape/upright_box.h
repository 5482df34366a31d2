// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "mapping/shape/convex_outline.h"

namespace dhpmap {

/// A box with vertical sides, z being up.
struct UprightBox {
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0;  ///< of its first side, counterclockwise from x; above -pi/2, to pi/2
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< from side to side; the first is no less than the second
};

/// The box from one height to another whose sides are over those of a rectangle.
UprightBox BoxOn(const Rectangle& rectangle, double low_m, double high_m);

/// The upright box of least volume around a footprint, not empty, from one height to another.
UprightBox BoxOver(const ConvexOutline& footprint_m, double low_m, double high_m);

/// Its corners from above.
ConvexOutline FootprintOf(const UprightBox& box);

/// The volume that two have in common by that of both together; 0 if neither has any.
double IntersectionOverUnion(const UprightBox& a, const UprightBox& b);

}  // namespace dhpmap

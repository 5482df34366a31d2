// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <variant>

#include "mapping/base/transform.h"

namespace dhpmap {

/// All points within radius_m of the segment from a to b; a sphere where both are the same.
struct Capsule {
  Eigen::Vector3d a_m, b_m;
  double radius_m;
};

/// The points of a box of its own frame: no farther than half_m from its origin along each axis.
struct OrientedBox {
  Transform T_world_box;
  Eigen::Vector3d half_m;
};

/// A convex body, in whichever frame. Sizes are finite and not negative.
using Body = std::variant<Capsule, OrientedBox>;

// Of either kind:

Eigen::AlignedBox3d BoundsOf(const Capsule& capsule);
Eigen::AlignedBox3d BoundsOf(const OrientedBox& box);

Eigen::Vector3d CentreOf(const Capsule& capsule);
Eigen::Vector3d CentreOf(const OrientedBox& box);

/// The body, if p_there = T_there_here * p_here.
Capsule Moved(const Transform& T_there_here, const Capsule& capsule);
OrientedBox Moved(const Transform& T_there_here, const OrientedBox& box);
/// The body, shifted.
Capsule Shifted(const Capsule& capsule, const Eigen::Vector3d& by_m);
OrientedBox Shifted(const OrientedBox& box, const Eigen::Vector3d& by_m);

/// At least so thick: `half_m` from its middle, or its axis, to its sides.
Capsule AtLeast(double half_m, const Capsule& capsule);
OrientedBox AtLeast(double half_m, const OrientedBox& box);

/// Of the line along x through (0, y, z), the part in the body.
struct Row {
  double first_m, last_m;  ///< none of it: first > last
};
Row RowIn(const Capsule& capsule, double y_m, double z_m);
Row RowIn(const OrientedBox& box, double y_m, double z_m);

}  // namespace dhpmap

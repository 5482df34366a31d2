// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <variant>

#include "mapping/base/transform.h"

namespace dhpmap {

/// All points within radius_m of the segment from a to b; a sphere if a equals b.
struct Capsule {
  Eigen::Vector3d a_m, b_m;
  double radius_m;
};

/// A box in its own frame: at most half_m from the origin along each axis.
struct OrientedBox {
  Transform T_world_box;
  Eigen::Vector3d half_m;
};

/// A convex body, in any frame. Sizes are finite and not negative.
using Body = std::variant<Capsule, OrientedBox>;

// For either kind:

Eigen::AlignedBox3d BoundsOf(const Capsule& capsule);
Eigen::AlignedBox3d BoundsOf(const OrientedBox& box);

Eigen::Vector3d CentreOf(const Capsule& capsule);
Eigen::Vector3d CentreOf(const OrientedBox& box);

/// The body transformed by p_there = T_there_here * p_here.
Capsule Moved(const Transform& T_there_here, const Capsule& capsule);
OrientedBox Moved(const Transform& T_there_here, const OrientedBox& box);
/// The body, shifted.
Capsule Shifted(const Capsule& capsule, const Eigen::Vector3d& by_m);
OrientedBox Shifted(const OrientedBox& box, const Eigen::Vector3d& by_m);

/// The body with a minimum half thickness of `half_m`, from its middle or axis to its sides.
Capsule AtLeast(double half_m, const Capsule& capsule);
OrientedBox AtLeast(double half_m, const OrientedBox& box);

/// The part of the line along x through (0, y, z) inside the body.
struct Row {
  double first_m, last_m;  ///< empty if first > last
};
Row RowIn(const Capsule& capsule, double y_m, double z_m);
Row RowIn(const OrientedBox& box, double y_m, double z_m);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <variant>

#include "mapping/submap/bounding_sphere.h"

namespace dhpmap {

/// A box along the axes, or a sphere; map frame. Borders belong to it.
using Region = std::variant<Eigen::AlignedBox3d, BoundingSphere>;

bool Contains(const Region& region, const Eigen::Vector3d& p_map_m);
/// Whether it has a point in common with a ball.
bool Touches(const Region& region, const Eigen::Vector3d& center_map_m, double radius_m);
/// The smallest around it.
BoundingSphere SphereAround(const Region& region);
/// The same numbers.
bool IsSame(const Region& a, const Region& b);

}  // namespace dhpmap

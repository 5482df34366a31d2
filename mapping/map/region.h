// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <variant>

#include "mapping/submap/bounding_sphere.h"

namespace dhpmap {

/// An axis-aligned box, or a sphere; map frame. Closed: borders are part of it.
using Region = std::variant<Eigen::AlignedBox3d, BoundingSphere>;

bool Contains(const Region& region, const Eigen::Vector3d& p_map_m);
/// Whether it intersects a ball.
bool Touches(const Region& region, const Eigen::Vector3d& center_map_m, double radius_m);
/// The smallest enclosing sphere.
BoundingSphere SphereAround(const Region& region);
/// Exact equality.
bool IsSame(const Region& a, const Region& b);

}  // namespace dhpmap

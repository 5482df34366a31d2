// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "clients/simulator/solid.h"

namespace dhpmap::simulator {

using SolidList = std::vector<const Solid*>;

/// The first hit of a ray among some solids within max_m.
struct SolidHit {
  double distance_m;
  const Solid* solid;
};
std::optional<SolidHit> FirstOf(std::span<const Solid* const> solids, const Ray& ray, double max_m);

/// Signed distance to the nearest of the solids, exact outside.
double DistanceTo(std::span<const Solid* const> solids, const Eigen::Vector3d& p);

/// Bounds of the solids; those of a rotated solid ignore its rounding and may be too large.
Eigen::AlignedBox3d BoundsOf(std::span<const Solid* const> solids);

/// Points on the surface of each solid: entry points of axis-parallel rays, `step_m` apart.
std::vector<Eigen::Vector3d> PointsOn(std::span<const Solid* const> solids, double step_m);

}  // namespace dhpmap::simulator

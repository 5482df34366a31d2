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

/// What a ray meets first of some solids within max_m.
struct SolidHit {
  double distance_m;
  const Solid* solid;
};
std::optional<SolidHit> FirstOf(std::span<const Solid* const> solids, const Ray& ray, double max_m);

/// Signed distance to the nearest of some solids, exact outside.
double DistanceTo(std::span<const Solid* const> solids, const Eigen::Vector3d& p);

/// Around some solids: around a rounded solid that is turned, to its rounding.
Eigen::AlignedBox3d BoundsOf(std::span<const Solid* const> solids);

/// Points on the surface of each solid: where rays along all axes, `step_m` apart, enter it.
std::vector<Eigen::Vector3d> PointsOn(std::span<const Solid* const> solids, double step_m);

}  // namespace dhpmap::simulator

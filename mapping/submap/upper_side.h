// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "mapping/submap/submap.h"

namespace dhpmap {

// Where other things may stand on an object.

/// In the map frame: centre of the part of its surface at the support height; it may lie off the surface, as in a ring.
/// Nothing without a support height. Throws StatusError if voxels cannot be read, as does the function below.
std::optional<Eigen::Vector3d> MiddleOfUpperSide(const Submap& submap);

/// In the map frame: the highest surface point at an x and y that faces up within 45 degrees, accurate to 1.5 voxels.
/// Nothing if there is none.
std::optional<Eigen::Vector3d> SurfaceFromAbove(const Submap& submap, const Eigen::Vector2d& point_m);

}  // namespace dhpmap

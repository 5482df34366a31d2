// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "mapping/submap/submap.h"

namespace dhpmap {

// Where things may stand on an object.

/// In the map frame: the middle of the part at its support height, on the surface or beside it (a ring). Nothing if it
/// has none. Throws StatusError if voxels cannot be read, as does what follows.
std::optional<Eigen::Vector3d> MiddleOfUpperSide(const Submap& submap);

/// In the map frame: the highest point at an x and y, to a voxel and a half, of what of the surface faces up by 45
/// degrees or more. Nothing if there is none.
std::optional<Eigen::Vector3d> SurfaceFromAbove(const Submap& submap, const Eigen::Vector2d& point_m);

}  // namespace dhpmap

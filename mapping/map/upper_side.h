// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mapping/map/submap.h"
#include "mapping/map/surface_crossings.h"

namespace dhpmap {

// Where things may stand on an object.

/// Of crossings in a frame whose z is up: the height of the highest part that is level, to 25 degrees and a voxel and a
/// half, and has half as many of them as the largest. Nothing if none is as large as a quarter of `footprint_m2`: the
/// top of a ball is smaller.
std::optional<double> SupportHeight(const std::vector<SurfaceCrossing>& crossings, double voxel_size_m,
                                    double footprint_m2);

/// In the map frame: the middle of the part at its support height, on the surface or beside it (a ring). Nothing if it
/// has none. Throws StatusError if voxels cannot be read, as does what follows.
std::optional<Eigen::Vector3d> MiddleOfUpperSide(const Submap& submap);

/// In the map frame: the highest point at an x and y, to a voxel and a half, of what of the surface faces up by 45
/// degrees or more. Nothing if there is none.
std::optional<Eigen::Vector3d> SurfaceFromAbove(const Submap& submap, const Eigen::Vector2d& point_m);

}  // namespace dhpmap

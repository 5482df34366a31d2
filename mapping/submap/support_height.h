// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "mapping/submap/surface_crossings.h"

namespace dhpmap {

/// How steep a surface is that things may stand on: the cosine of 25 degrees; and how thick, in voxels.
inline constexpr double kLeastLevel = 0.90630779;
inline constexpr double kLevel_vox = 1.5;

/// Of crossings whose normals have at least so much of z, in a frame whose z is up: ascending.
std::vector<double> HeightsFacingUp(const std::vector<SurfaceCrossing>& crossings, double least_up);

/// Of crossings in a frame whose z is up: the height of the highest part that is level, to 25 degrees and a voxel and a
/// half, and has half as many of them as the largest. Nothing if none is as large as a quarter of `footprint_m2`: the
/// top of a ball is smaller.
std::optional<double> SupportHeight(const std::vector<SurfaceCrossing>& crossings, double voxel_size_m,
                                    double footprint_m2);

}  // namespace dhpmap

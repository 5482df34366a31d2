// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "mapping/geometry/triangle_packet.h"

namespace dhpmap {

/// Whether a surface ends at the origin, a point of `triangles[0]`: it lies on an edge without a second triangle, or on
/// a corner with such an edge. `triangles`: all of the surface that contain the origin, and possibly others nearby.
/// Corners within `same_m` are one, because of rounding. False inside a triangle.
bool EndsAtOrigin(std::span<const TriangleCorners> triangles, float same_m);

}  // namespace dhpmap

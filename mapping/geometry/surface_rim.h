// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "mapping/geometry/triangle_packet.h"

namespace dhpmap {

/// Whether a surface ends at the origin, which is a point of `triangles[0]`: it lies on an edge that no other of them
/// has, or on a corner with such an edge. `triangles`: all of the surface that hold the origin, and maybe others around
/// it. Corners that are no farther apart than `same_m` are one: rounding. Within a triangle: no.
bool EndsAtOrigin(std::span<const TriangleCorners> triangles, float same_m);

}  // namespace dhpmap

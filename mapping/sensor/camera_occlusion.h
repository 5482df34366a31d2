// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/sensor/projected_point.h"

namespace dhpmap {

/// Which points of a scan the camera beside the scanner does not see, because others of the scan are before them: 1 for
/// these, one a point. A point counts as hidden if its pixel lies amid those of points nearer by half a metre and a
/// tenth: in the convex hull of those around it, or of those beside it. How far these may be away bridges the gaps
/// between this scan's beams. So no part of a plane is hidden that does not
/// run away by more than that within these distances, nor what is beside or above a near thing in the image,
/// but for a little at its foot, which the ground before it helps to enclose. A hole of up to 1/21 of the image's width
/// or four rows of beams counts as closed. The flags do not depend on the order of points; time is linear in points and
/// pixels, wherever the points are. Thread-safe.
std::vector<std::uint8_t> FindHiddenPoints(std::span<const ProjectedPoint> points, int width_px, int height_px);

}  // namespace dhpmap

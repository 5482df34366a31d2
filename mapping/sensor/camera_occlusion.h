// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/sensor/projected_point.h"

namespace dhpmap {

/// Flags the points of a scan that the camera beside the scanner cannot see, because other points of the scan hide
/// them: one value per point, 1 for hidden. A point is hidden if its pixel is enclosed by pixels of points that are
/// nearer by half a metre and a tenth: it lies in the convex hull of those around it, or of those beside it. The search
/// distance bridges the gaps between this scan's beams. So no part of a plane is hidden unless its depth changes by
/// more than that within this distance. Points beside or above a near thing in the image are not hidden, except a few
/// at its foot, which the ground in front of it helps to enclose. A hole of up to 1/21 of the image's width or four
/// rows of beams counts as closed. The flags do not depend on the order of points. The time is always linear in points
/// and pixels. Thread-safe.
std::vector<std::uint8_t> FindHiddenPoints(std::span<const ProjectedPoint> points, int width_px, int height_px);

}  // namespace dhpmap

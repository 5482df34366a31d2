// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/bounding_sphere.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// True if any part of the sphere (map frame) may be in the sensor's view: within range and, for a camera, not wholly
/// on the outer side of a border of the image.
bool MayBeInView(const PanopticFrame& frame, double max_range_m, const BoundingSphere& sphere);

/// True if the sphere's centre should have been seen: in range, inside the image, and not hidden behind what was
/// measured there. Pixels without a return say nothing, so the answer is then false. LiDAR: in range.
bool ShouldBeSeen(const PanopticFrame& frame, double max_range_m, const BoundingSphere& sphere);

}  // namespace dhpmap

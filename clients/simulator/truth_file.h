// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "clients/simulator/apartment.h"
#include "clients/simulator/instance_views.h"

namespace dhpmap::simulator {

/// truth.json: what a map of the recording should answer. A list, an entry an instance that some frame sees: id, class,
/// name, kind ("thing" or "stuff"), size ("S", "M", "L"), box_m {min, max}, seen_box_m {center, size, yaw_deg} (the
/// least upright box around what any pixel of a depth image shows of it, noise left out: SeenPart), point_m (on its
/// surface, in full view of the camera), margin_px (of that point to the border of its surface), num_frames (that see
/// enough of it), relations (of a thing to others that are in the list, a list of kind ("ON", "IN", "HANGS_ON",
/// "NEXT_TO"), object (an id) and what led to it: support of ON, gap_m and height_share of NEXT_TO; the rules:
/// truth_relations.h).
std::string TruthJson(const ApartmentScene& scene, std::span<const InstanceView> views);

}  // namespace dhpmap::simulator

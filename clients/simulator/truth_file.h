// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "clients/simulator/apartment.h"
#include "clients/simulator/instance_views.h"

namespace dhpmap::simulator {

/// truth.json: the expected answers of a map of the recording. A list with an entry for each instance that some frame
/// sees: id, class, name, kind ("thing" or "stuff"), size ("S", "M", "L"), box_m {min, max}, seen_box_m {center, size,
/// yaw_deg} (the smallest upright box around all pixels of it in depth images, without noise: SeenPart), point_m (on
/// its surface, fully visible), margin_px (from that point to the border of its surface), num_frames (frames that see
/// enough of it), relations (of a thing to others in the list: kind ("ON", "IN", "HANGS_ON", "NEXT_TO"), object (an id)
/// and the measures: support of ON, gap_m and height_share of NEXT_TO; rules: truth_relations.h).
std::string TruthJson(const ApartmentScene& scene, std::span<const InstanceView> views);

}  // namespace dhpmap::simulator

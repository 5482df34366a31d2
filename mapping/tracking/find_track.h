// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "mapping/map/map.h"

namespace dhpmap {

/// The submap with this track id in a session; null: none. A track id without a recorded session matches every session.
const Submap* FindTrack(const Map& map, const std::string& session, std::uint32_t track_id);

}  // namespace dhpmap

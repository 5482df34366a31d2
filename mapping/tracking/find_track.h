// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "mapping/map/map.h"

namespace dhpmap {

/// What `track_id` means in a session; null: nothing. Where nobody has noted whose track a thing is, it is any
/// session's.
const Submap* FindTrack(const Map& map, const std::string& session, std::uint32_t track_id);

}  // namespace dhpmap

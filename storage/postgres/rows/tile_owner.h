// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap::postgres {

/// Column tiles.owner_id of what belongs to the map itself; of a submap it is the id.
inline constexpr std::int64_t kMapsOwner = -1;

}  // namespace dhpmap::postgres

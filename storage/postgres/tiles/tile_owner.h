// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap::postgres {

/// Value of tiles.owner_id for layers of the map itself. For a submap it is the submap's id.
inline constexpr std::int64_t kMapsOwner = -1;

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "storage/postgres/owners/owned_map.h"
#include "storage/postgres/pool.h"

namespace dhpmap::postgres {

/// Whether the commit that would raise a map's counter to `commit_id` was made. Waits for a backend that still works on
/// it, so the answer is final. UNAVAILABLE if the database does not answer; NotOwner if another server has taken the
/// map; NOT_FOUND if it is gone.
Result<bool> WasMade(Pool& pool, const OwnedMap& map, std::int64_t commit_id);

/// UNAVAILABLE, reason NOT_OWNER: another server writes the map now.
Status NotOwner(const std::string& map);

}  // namespace dhpmap::postgres

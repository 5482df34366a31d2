// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Writes the submap and block rows that `changes` name, within the caller's transaction; encodes on `pool`. On error
/// the caller rolls back. FAILED_PRECONDITION if the stored blocks are not those that the changes started from.
Status WriteChanges(sqlite::Database& database, std::int64_t map_key, const std::vector<SubmapChange>& changes,
                    ThreadPool& pool);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Reads a whole map within the caller's transaction; decodes on `pool`. Its tiles know that they are in `store`.
/// NOT_FOUND; DATA_LOSS naming map, submap, layer and tile where something is damaged or missing.
Result<std::shared_ptr<const MapSnapshot>> ReadSnapshot(sqlite::Database& database, const std::string& name,
                                                        std::uint16_t store, ThreadPool& pool);

}  // namespace dhpmap

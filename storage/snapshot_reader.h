// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Reads a whole map within the caller's transaction; decodes on `pool`. NOT_FOUND; DATA_LOSS naming map, submap and
/// block where something is damaged or missing.
Result<std::shared_ptr<const MapSnapshot>> ReadSnapshot(sqlite::Database& database, const std::string& name,
                                                        ThreadPool& pool);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/reading/page_reader.h"

namespace dhpmap::postgres {

/// Reads a map. Its tiles get storage keys of `store`. `pages`: leaves the tiles of objects in the database, to be read
/// on demand; null: reads them too. Errors as MapStore::LoadMap.
Result<std::shared_ptr<const MapSnapshot>> ReadMapState(Connection& connection, const std::string& name,
                                                        std::int64_t map_key, std::uint16_t store, ThreadPool& pool,
                                                        const std::shared_ptr<PageReader>& pages = nullptr);

}  // namespace dhpmap::postgres

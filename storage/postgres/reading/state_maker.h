// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/reading/page_reader.h"
#include "storage/rows/map_row.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap::postgres {

/// Makes the state from a filled row, its submaps' rows and all tiles, which it reads in the caller's transaction.
/// Takes the row's info. DATA_LOSS; FAILED_PRECONDITION for a layer of a later version.
Result<std::shared_ptr<const MapSnapshot>> MakeState(Connection& connection, MapRow& map,
                                                     const std::vector<SubmapRow>& rows, std::uint16_t store,
                                                     ThreadPool& pool);

/// The same, but `pages` reads the tiles of objects on demand.
Result<std::shared_ptr<const MapSnapshot>> MakePagedState(Connection& connection, MapRow& map,
                                                          const std::vector<SubmapRow>& rows, std::uint16_t store,
                                                          ThreadPool& pool, const std::shared_ptr<PageReader>& pages);

}  // namespace dhpmap::postgres

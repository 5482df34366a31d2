// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "storage/sqlite/database.h"

namespace dhpmap {

/// Runs its argument as one write transaction.
using WriteRows = std::function<Status(const std::function<Status(sqlite::Database&)>&)>;

/// Keys of a map's submaps with rows of unknown block occupancy, ascending; linear in their number.
Result<std::vector<std::int64_t>> OwnersWithoutCells(sqlite::Database& database, std::int64_t map_key);

/// Fills in the column tiles.cells of a map, which older versions left empty: decodes the blobs of such rows, in
/// transactions of some ms each. Stops at the first error and keeps the work done. DATA_LOSS for damaged data, as on
/// loading the map.
Status NoteTileCells(const WriteRows& write, const std::string& map);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "storage/sqlite/database.h"

namespace dhpmap {

/// Runs its argument as one transaction that writes.
using WriteRows = std::function<Status(const std::function<Status(sqlite::Database&)>&)>;

/// The keys of a map's submaps with rows of tiles that do not say which blocks they have, ascending; costs what there
/// are.
Result<std::vector<std::int64_t>> OwnersWithoutCells(sqlite::Database& database, std::int64_t map_key);

/// Has all rows of a map's tiles say which blocks they have (column tiles.cells), which those of older versions do not:
/// decodes the blobs of those that do not say it, in transactions of some ms each. Ends with the first error, and keeps
/// what was done. DATA_LOSS for what is damaged, as whoever loads the map is told.
Status NoteTileCells(const WriteRows& write, const std::string& map);

}  // namespace dhpmap

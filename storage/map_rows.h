// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/map/map.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// Rows of maps, map_config and label_classes <-> MapInfo. A map's row carries a checksum of all three; readers answer
// DATA_LOSS where it does not match.

struct MapRow {
  std::int64_t key = 0;
  MapInfo info;
  std::int64_t num_submaps = 0;
};

/// NOT_FOUND if there is no such map. FAILED_PRECONDITION if its config has keys that this version does not know.
Result<MapRow> ReadMap(sqlite::Database& database, const std::string& name);
/// Names in ascending order.
Result<std::vector<std::string>> ReadMapNames(sqlite::Database& database);

/// What a commit compares with the state it starts from.
struct MapHead {
  std::int64_t key = 0;
  std::int64_t revision = 0;
  std::int64_t create_time_ns = 0;
};
Result<MapHead> ReadMapHead(sqlite::Database& database, const std::string& name);

/// Returns the new map's key. ALREADY_EXISTS if the name is taken.
Result<std::int64_t> InsertMap(sqlite::Database& database, const MapSnapshot& snapshot);
/// Writes config and label set only where they differ from `before`.
Status UpdateMap(sqlite::Database& database, std::int64_t map_key, const MapInfo& before, const MapSnapshot& after);
/// With everything it holds. NOT_FOUND if there is no such map.
Status DeleteMapRows(sqlite::Database& database, const std::string& name);

}  // namespace dhpmap

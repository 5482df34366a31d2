// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mapping/map/map_config.h"
#include "storage/rows/table.h"

namespace dhpmap {

namespace sqlite {
class Database;
}

/// One key of a map's config, as text.
struct ConfigRow {
  std::int64_t map_key = 0;
  std::string key;
  std::string value;
};
const Table<ConfigRow>& ConfigTable();

/// Of every key and of MapConfig::left_out, by ascending key.
std::vector<ConfigRow> ConfigRowsOf(std::int64_t map_key, const MapConfig& config);
/// By ascending key.
Result<std::vector<ConfigRow>> ReadConfigRows(sqlite::Database& database, std::int64_t map_key);
/// Writes every key of `config` in place of what is stored. Returns the rows, by ascending key.
Result<std::vector<ConfigRow>> WriteConfigRows(sqlite::Database& database, std::int64_t map_key,
                                               const MapConfig& config);

/// Over keys and values as they are stored, whatever keys this version knows.
std::uint32_t ConfigChecksum(const std::vector<ConfigRow>& rows);

/// Keys that are not among the rows have their defaults; retired keys at their defaults are ignored, some others are
/// listed (MapConfig::left_out).
/// FAILED_PRECONDITION, reason NEWER_CONFIG, for a key or value that this version does not know, and RETIRED_CONFIG for
/// one that it no longer knows: mapping would go on by other rules than it began with.
Result<MapConfig> ConfigOf(const std::vector<ConfigRow>& rows);

}  // namespace dhpmap

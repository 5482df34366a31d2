// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/config_rows.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "storage/sqlite/database.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadConfigTask[] = "read a map's config";
constexpr char kWriteConfigTask[] = "write a map's config";
constexpr std::string_view kIs = " = ";  // between key and value in MapConfig::left_out

}  // namespace

const Table<ConfigRow>& ConfigTable() {
  using enum Written;
  static const Table<ConfigRow> table("map_config",
                                      {
                                          MakeColumn<ConfigRow>("map_key", kOnce, 0, DHPMAP_MEMBER(map_key)),
                                          MakeColumn<ConfigRow>("key", kOnce, 2, DHPMAP_MEMBER(key)),
                                          MakeColumn<ConfigRow>("value", kAlways, 2, DHPMAP_MEMBER(value)),
                                      });
  return table;
}

Result<std::vector<ConfigRow>> ReadConfigRows(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare(ConfigTable().Select("WHERE map_key = ? ORDER BY key"), kReadConfigTask));
  select.Bind(map_key);
  std::vector<ConfigRow> rows;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return rows;
    if (!ConfigTable().Read(select, rows.emplace_back())) return DataLoss("its config is damaged");
  }
}

Result<std::vector<ConfigRow>> WriteConfigRows(Database& database, std::int64_t map_key, const MapConfig& config) {
  DHPMAP_ASSIGN_OR_RETURN(Statement clear,
                          database.Prepare("DELETE FROM map_config WHERE map_key = ?", kWriteConfigTask));
  DHPMAP_RETURN_IF_ERROR(clear.Bind(map_key).Run());
  std::vector<ConfigRow> rows = ConfigRowsOf(map_key, config);
  DHPMAP_ASSIGN_OR_RETURN(Statement insert, database.Prepare(ConfigTable().Insert(), kWriteConfigTask));
  for (const ConfigRow& row : rows) {
    ConfigTable().BindAll(row, insert);
    DHPMAP_RETURN_IF_ERROR(insert.Run());
  }
  return rows;
}

std::uint32_t ConfigChecksum(const std::vector<ConfigRow>& rows) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const ConfigRow& row : rows) {
    writer.PutText(row.key);
    writer.PutText(row.value);
  }
  return Crc32c(bytes);
}

Result<MapConfig> ConfigOf(const std::vector<ConfigRow>& rows) {
  MapConfig config;
  for (const ConfigRow& row : rows) {
    const Status set = SetField(config, row.key, row.value);
    if (set.ok()) continue;
    const RetiredField* const retired = FindRetiredField(row.key);
    if (retired != nullptr && retired->is_left_out) {
      config.left_out.push_back(row.key + std::string(kIs) + row.value);
      continue;
    }
    if (retired != nullptr) {
      return FailedPrecondition("the map was built with " + row.key + " = " + row.value +
                                ", which this version cannot go on with: serve it with the version that wrote it, or "
                                "map its frames again")
          .WithReason("RETIRED_CONFIG");
    }
    return FailedPrecondition("the map's config is not of this version: " + set.message()).WithReason("NEWER_CONFIG");
  }
  return config;
}

std::vector<ConfigRow> ConfigRowsOf(std::int64_t map_key, const MapConfig& config) {
  std::vector<ConfigRow> rows;
  for (auto& [key, value] : ConfigToText(config)) rows.push_back({map_key, key, value});
  for (const std::string& setting : config.left_out) {
    const std::size_t end_of_key = setting.find(kIs);
    rows.push_back({map_key, setting.substr(0, end_of_key), setting.substr(end_of_key + kIs.size())});
  }
  std::sort(rows.begin(), rows.end(), [](const ConfigRow& a, const ConfigRow& b) { return a.key < b.key; });
  return rows;
}

}  // namespace dhpmap

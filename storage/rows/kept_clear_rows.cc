// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/kept_clear_rows.h"

#include <utility>

#include "storage/sqlite/database.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadKeptClearTask[] = "read the regions that a map keeps clear";
constexpr char kWriteKeptClearTask[] = "write the regions that a map keeps clear";

bool Has(const KeptClear& kept_clear, const KeptClearRegion& region) {
  const KeptClearRegion* found = kept_clear.Find(region.name);
  return found != nullptr && *found == region;
}

}  // namespace

const Table<KeptClearRow>& KeptClearTable() {
  static const Table<KeptClearRow> table("kept_clear", KeptClearColumns());
  return table;
}

Result<std::vector<KeptClearRow>> ReadKeptClearRows(Database& database, std::int64_t map_key) {
  const Table<KeptClearRow>& table = KeptClearTable();
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare(table.Select("WHERE map_key = ? ORDER BY name"), kReadKeptClearTask));
  select.Bind(map_key);
  std::vector<KeptClearRow> rows;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return rows;
    if (!table.Read(select, rows.emplace_back())) return DataLoss("a region that it keeps clear is damaged");
  }
}

Result<std::vector<KeptClearRow>> WriteKeptClearRows(Database& database, std::int64_t map_key, const KeptClear& before,
                                                     const KeptClear& after) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement erase, database.Prepare("DELETE FROM kept_clear WHERE map_key = ? AND name = ?", kWriteKeptClearTask));
  for (const KeptClearRegion& region : before.list()) {
    if (after.Find(region.name) == nullptr) DHPMAP_RETURN_IF_ERROR(erase.Bind(map_key).Bind(region.name).Run());
  }
  const Table<KeptClearRow>& table = KeptClearTable();
  DHPMAP_ASSIGN_OR_RETURN(Statement upsert, database.Prepare(table.Upsert(), kWriteKeptClearTask));
  std::vector<KeptClearRow> rows;
  for (const KeptClearRegion& region : after.list()) {
    const KeptClearRow& row = rows.emplace_back(KeptClearRow{map_key, region});
    if (Has(before, region)) continue;
    table.BindAll(row, upsert);
    DHPMAP_RETURN_IF_ERROR(upsert.Run());
  }
  return rows;
}

std::uint32_t KeptClearChecksum(const std::vector<KeptClearRow>& rows, int version) {
  Bytes bytes;
  for (const KeptClearRow& row : rows) KeptClearTable().Cover(row, version, bytes);
  return Crc32c(bytes);
}

Result<KeptClear> KeptClearOf(const std::vector<KeptClearRow>& rows) {
  std::vector<KeptClearRegion> regions;
  for (const KeptClearRow& row : rows) regions.push_back(row.region);
  return KeptClear::Create(std::move(regions));
}

}  // namespace dhpmap

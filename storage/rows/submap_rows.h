// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "mapping/submap/submap.h"
#include "mapping/submap/submap_fields.h"
#include "storage/commit/state_tables.h"
#include "storage/rows/table.h"
#include "storage/sqlite/database.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap {

struct SubmapRow {
  std::int64_t key = 0;
  std::int64_t map_key = 0;
  SubmapInfo info;
  BoundingSphere sphere;
  std::shared_ptr<const LevelOutline> outline;  ///< null: unknown
  SubmapCounts counts;
  std::int64_t tiles_sum = 0;  ///< see TileTotals
  RowSeal seal;

  /// Whether it has a sum of its rows in tiles; rows of schema 6 and before only have their number.
  [[nodiscard]] bool CoversTiles() const { return seal.version >= 3; }
};

/// A column, and its position among those that the checksum covers.
template <typename Row>
struct PlacedColumn {
  int place;
  Column<Row> column;
};

/// The columns of fields of SubmapInfo.
template <typename Row>
std::vector<PlacedColumn<Row>> InfoColumns() {
  std::vector<PlacedColumn<Row>> columns;
  VisitSubmapFields([&columns]<typename Field>(const Field& field) {
    const bool is_key = std::is_same_v<std::remove_cvref_t<decltype(Field::Of(std::declval<SubmapInfo&>()))>, SubmapId>;
    const auto access = [](auto& row) -> auto& { return Field::Of(row.info); };
    columns.push_back(
        {field.place, MakeColumn<Row>(field.name, is_key ? Written::kOnce : Written::kAlways, field.since, access)});
  });
  return columns;
}

/// The columns of table submaps. `Row` is a SubmapRow, or derived from it. Version 1 of the checksum covers the columns
/// in the order of their places, which are frozen: new columns, and new fields of SubmapInfo, take the next.
template <typename Row = SubmapRow>
std::vector<Column<Row>> SubmapColumns() {
  using enum Written;
  std::vector<PlacedColumn<Row>> placed = InfoColumns<Row>();
  const auto add = [&placed](int place, Column<Row> column) { placed.push_back({place, column}); };
  add(-4, MakeColumn<Row>("submap_key", kElsewhere, 0, DHPMAP_MEMBER(key)));
  add(-3, MakeColumn<Row>("blob_bytes", kAlways, 0, DHPMAP_MEMBER(counts.blob_bytes)));
  add(-2, MakeColumn<Row>("checksum_version", kAlways, 0, DHPMAP_MEMBER(seal.version)));
  add(-1, MakeColumn<Row>("checksum", kAlways, 0, DHPMAP_MEMBER(seal.checksum)));
  add(0, MakeColumn<Row>("map_key", kOnce, 1, DHPMAP_MEMBER(map_key)));
  add(14, MakeColumn<Row>("num_tsdf_blocks", kAlways, 1, DHPMAP_MEMBER(counts.num_tsdf_blocks)));
  add(15, MakeColumn<Row>("num_label_blocks", kAlways, 1, DHPMAP_MEMBER(counts.num_label_blocks)));
  add(18, MakeColumn<Row>("sphere", kAlways, 1, DHPMAP_MEMBER(sphere)));
  add(23, MakeColumn<Row>("num_gone_blocks", kAlways, 2, DHPMAP_MEMBER(counts.num_gone_blocks)));
  add(27, MakeColumn<Row>("tiles_sum", kAlways, 3, DHPMAP_MEMBER(tiles_sum)));
  add(31, MakeColumn<Row>("outline", kAlways, 6, DHPMAP_MEMBER(outline)));
  std::sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.place < b.place; });
  std::vector<Column<Row>> columns;
  for (const PlacedColumn<Row>& one : placed) columns.push_back(one.column);
  return columns;
}
const Table<SubmapRow>& Submaps();

/// The row of a submap as it is now, sealed.
SubmapRow SubmapRowOf(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts, std::int64_t tiles_sum);

/// The rows of a map, by ascending submap id. DATA_LOSS, naming the submap, on a checksum mismatch; if `damaged` is not
/// null, such rows are added to it instead.
Result<std::vector<SubmapRow>> ReadSubmaps(sqlite::Database& database, std::int64_t map_key,
                                           std::vector<SubmapRow>* damaged = nullptr);

/// Writes submap rows and their boxes. One for each transaction.
class SubmapRowWriter final : public SubmapTable {
 public:
  static Result<SubmapRowWriter> Prepare(sqlite::Database& database);

  Result<std::optional<Stored>> Find(std::int64_t map_key, SubmapId id) override;
  Result<std::int64_t> Write(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts,
                             std::int64_t tiles_sum) override;
  /// The same for a row that was read; key and checksum are set anew.
  Result<std::int64_t> Write(SubmapRow row);
  Status Erase(std::int64_t submap_key) override;

 private:
  SubmapRowWriter(sqlite::Statement find, sqlite::Statement upsert, sqlite::Statement erase,
                  sqlite::Statement write_box, sqlite::Statement erase_box);
  Status WriteBox(std::int64_t map_key, std::int64_t submap_key, const BoundingSphere& in_map);
  sqlite::Statement find_, upsert_, erase_, write_box_, erase_box_;
};

}  // namespace dhpmap

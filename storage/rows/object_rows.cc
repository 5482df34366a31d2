// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/object_rows.h"

#include <algorithm>
#include <utility>

#include "storage/sqlite/database.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadObjectsTask[] = "read what is known of a map's objects";
constexpr char kWriteObjectsTask[] = "write what is known of a map's objects";

template <typename Row>
Result<std::vector<Row>> ReadObjectRows(Database& database, const Table<Row>& table, std::string_view tail,
                                        std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare(table.Select(tail), kReadObjectsTask));
  select.Bind(map_key);
  std::vector<Row> rows;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return rows;
    if (!table.Read(select, rows.emplace_back())) return DataLoss("what is known of its objects is damaged");
  }
}

/// Writes the rows of `entries` for which `is_stored` returns false.
template <typename Row, typename Entries, typename IsStored>
Result<std::vector<Row>> WriteObjectRows(Database& database, const Table<Row>& table, std::int64_t map_key,
                                         const Entries& entries, IsStored&& is_stored) {
  DHPMAP_ASSIGN_OR_RETURN(Statement upsert, database.Prepare(table.Upsert(), kWriteObjectsTask));
  std::vector<Row> rows;
  rows.reserve(entries.size());
  for (const auto& entry : entries) {
    const Row& row = rows.emplace_back(Row{map_key, entry});
    if (is_stored(entry)) continue;
    table.BindAll(row, upsert);
    DHPMAP_RETURN_IF_ERROR(upsert.Run());
  }
  return rows;
}

template <typename Row>
std::uint32_t ChecksumOf(const Table<Row>& table, const std::vector<Row>& rows, int version) {
  Bytes bytes;
  for (const Row& row : rows) table.Cover(row, version, bytes);
  return Crc32c(bytes);
}

}  // namespace

const Table<MergedRow>& MergedTable() {
  static const Table<MergedRow> table("merged_ids", MergedColumns());
  return table;
}

const Table<PairRow>& PairTable() {
  static const Table<PairRow> table("object_pairs", PairColumns());
  return table;
}

Result<std::vector<MergedRow>> ReadMergedRows(Database& database, std::int64_t map_key) {
  return ReadObjectRows(database, MergedTable(), "WHERE map_key = ? ORDER BY merged_id", map_key);
}

Result<std::vector<PairRow>> ReadPairRows(Database& database, std::int64_t map_key) {
  return ReadObjectRows(database, PairTable(), "WHERE map_key = ? ORDER BY first_id, second_id", map_key);
}

Result<std::vector<MergedRow>> WriteMergedRows(Database& database, std::int64_t map_key, const MergedIds& before,
                                               const MergedIds& after) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement erase,
      database.Prepare("DELETE FROM merged_ids WHERE map_key = ? AND merged_id = ?", kWriteObjectsTask));
  for (const MergedId& old : before.list()) {
    if (!after.Into(old.merged)) DHPMAP_RETURN_IF_ERROR(erase.Bind(map_key).Bind(old.merged.value).Run());
  }
  return WriteObjectRows(database, MergedTable(), map_key, after.list(),
                         [&before](const MergedId& entry) { return before.Into(entry.merged) == entry.into; });
}

Result<std::vector<PairRow>> WritePairRows(Database& database, std::int64_t map_key, const ObjectPairs& before,
                                           const ObjectPairs& after) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement erase, database.Prepare("DELETE FROM object_pairs WHERE map_key = ? AND first_id = ? AND second_id = ?",
                                        kWriteObjectsTask));
  for (const ObjectPair& old : before.pairs()) {
    if (after.Of(old.first, old.second) != ObjectPair{.first = old.first, .second = old.second}) continue;
    DHPMAP_RETURN_IF_ERROR(erase.Bind(map_key).Bind(old.first.value).Bind(old.second.value).Run());
  }
  return WriteObjectRows(database, PairTable(), map_key, after.pairs(),
                         [&before](const ObjectPair& pair) { return before.Of(pair.first, pair.second) == pair; });
}

std::uint32_t MergedChecksum(const std::vector<MergedRow>& rows, int version) {
  return ChecksumOf(MergedTable(), rows, version);
}

std::uint32_t PairsChecksum(const std::vector<PairRow>& rows, int version) {
  return ChecksumOf(PairTable(), rows, version);
}

Result<MergedIds> MergedIdsOf(const std::vector<MergedRow>& rows) {
  std::vector<MergedId> list;
  list.reserve(rows.size());
  for (const MergedRow& row : rows) list.push_back(row.id);
  return MergedIds::Create(std::move(list));
}

Result<ObjectPairs> ObjectPairsOf(const std::vector<PairRow>& rows) {
  std::vector<ObjectPair> pairs;
  pairs.reserve(rows.size());
  for (const PairRow& row : rows) pairs.push_back(row.pair);
  return ObjectPairs::Create(std::move(pairs));
}

}  // namespace dhpmap

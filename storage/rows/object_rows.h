// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/merged_ids.h"
#include "mapping/map/object_pairs.h"
#include "storage/rows/table.h"

namespace dhpmap {

namespace sqlite {
class Database;
}

// Rows of merged_ids and object_pairs <-> MergedIds and ObjectPairs.

struct MergedRow {
  std::int64_t map_key = 0;
  MergedId id;
};

/// The columns of table merged_ids.
template <typename Row = MergedRow>
std::vector<Column<Row>> MergedColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("map_key", kOnce, 0, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("merged_id", kOnce, 5, DHPMAP_MEMBER(id.merged)),
      MakeColumn<Row>("into_id", kAlways, 5, DHPMAP_MEMBER(id.into)),
  };
}
const Table<MergedRow>& MergedTable();

struct PairRow {
  std::int64_t map_key = 0;
  ObjectPair pair;
};

/// The columns of table object_pairs.
template <typename Row = PairRow>
std::vector<Column<Row>> PairColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("map_key", kOnce, 0, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("first_id", kOnce, 5, DHPMAP_MEMBER(pair.first)),
      MakeColumn<Row>("second_id", kOnce, 5, DHPMAP_MEMBER(pair.second)),
      MakeColumn<Row>("verdict", kAlways, 5, DHPMAP_MEMBER(pair.verdict)),
      MakeColumn<Row>("evidence", kAlways, 5, DHPMAP_MEMBER(pair.evidence)),
  };
}
const Table<PairRow>& PairTable();

/// Ascending. DATA_LOSS for an invalid row.
Result<std::vector<MergedRow>> ReadMergedRows(sqlite::Database& database, std::int64_t map_key);
Result<std::vector<PairRow>> ReadPairRows(sqlite::Database& database, std::int64_t map_key);

/// Updates the rows from `before` to `after`, writing only differences. Returns all rows.
Result<std::vector<MergedRow>> WriteMergedRows(sqlite::Database& database, std::int64_t map_key,
                                               const MergedIds& before, const MergedIds& after);
Result<std::vector<PairRow>> WritePairRows(sqlite::Database& database, std::int64_t map_key, const ObjectPairs& before,
                                           const ObjectPairs& after);

/// `version`: of the map row's checksum, which covers these rows; 5 or later.
std::uint32_t MergedChecksum(const std::vector<MergedRow>& rows, int version);
std::uint32_t PairsChecksum(const std::vector<PairRow>& rows, int version);

/// DATA_LOSS unless they form a valid list.
Result<MergedIds> MergedIdsOf(const std::vector<MergedRow>& rows);
Result<ObjectPairs> ObjectPairsOf(const std::vector<PairRow>& rows);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/map/kept_clear.h"
#include "storage/rows/table.h"

namespace dhpmap {

namespace sqlite {
class Database;
}

/// An ignored region of a map.
struct KeptClearRow {
  std::int64_t map_key = 0;
  KeptClearRegion region;
};

/// The columns of table kept_clear.
template <typename Row = KeptClearRow>
std::vector<Column<Row>> KeptClearColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("map_key", kOnce, 0, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("name", kOnce, 7, DHPMAP_MEMBER(region.name)),
      MakeColumn<Row>("region", kAlways, 7, DHPMAP_MEMBER(region.region)),
  };
}
const Table<KeptClearRow>& KeptClearTable();

/// By ascending name. DATA_LOSS for an invalid row.
Result<std::vector<KeptClearRow>> ReadKeptClearRows(sqlite::Database& database, std::int64_t map_key);
/// Updates the rows from `before` to `after`, writing only differences. Returns all rows.
Result<std::vector<KeptClearRow>> WriteKeptClearRows(sqlite::Database& database, std::int64_t map_key,
                                                     const KeptClear& before, const KeptClear& after);

/// `version`: of the map row's checksum, which covers these rows; 7 or later.
std::uint32_t KeptClearChecksum(const std::vector<KeptClearRow>& rows, int version);

/// DATA_LOSS unless they are valid ignored regions.
Result<KeptClear> KeptClearOf(const std::vector<KeptClearRow>& rows);

}  // namespace dhpmap

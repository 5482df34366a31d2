// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "storage/rows/table.h"

namespace dhpmap {

/// The time that servers have observed to pass; at most one row.
struct SeenRow {
  std::int64_t clock = 1;
  std::int64_t seen_ns = 0;
  RowSeal seal;
};

/// The columns of table seen_time.
template <typename Row = SeenRow>
std::vector<Column<Row>> SeenColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("clock", kOnce, 0, DHPMAP_MEMBER(clock)),
      MakeColumn<Row>("checksum_version", kAlways, 0, DHPMAP_MEMBER(seal.version)),
      MakeColumn<Row>("checksum", kAlways, 0, DHPMAP_MEMBER(seal.checksum)),
      MakeColumn<Row>("seen_ns", kAlways, 1, DHPMAP_MEMBER(seen_ns)),
  };
}
const Table<SeenRow>& SeenTable();

}  // namespace dhpmap

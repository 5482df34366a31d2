// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/labels/label_set.h"
#include "storage/rows/table.h"

namespace dhpmap {

namespace sqlite {
class Database;
}

/// One class of a map's label set.
struct ClassRow {
  std::int64_t map_key = 0;
  LabelClass label;
};

/// The columns of table label_classes. `Row` is a ClassRow, or derived from it.
template <typename Row = ClassRow>
std::vector<Column<Row>> ClassColumns() {
  using enum Written;
  return {
      MakeColumn<Row>("map_key", kOnce, 0, DHPMAP_MEMBER(map_key)),
      MakeColumn<Row>("class_id", kOnce, 2, DHPMAP_MEMBER(label.id)),
      MakeColumn<Row>("name", kAlways, 2, DHPMAP_MEMBER(label.name)),
      MakeColumn<Row>("panoptic", kAlways, 2, DHPMAP_MEMBER(label.panoptic)),
      MakeColumn<Row>("size", kAlways, 2, DHPMAP_MEMBER(label.size)),
      MakeColumn<Row>("color_rgb", kAlways, 2, DHPMAP_MEMBER(label.color)),
  };
}
const Table<ClassRow>& Classes();

/// By ascending class id.
Result<std::vector<ClassRow>> ReadClassRows(sqlite::Database& database, std::int64_t map_key);
/// Replaces the stored classes. Returns the rows, by ascending class id.
Result<std::vector<ClassRow>> WriteClassRows(sqlite::Database& database, std::int64_t map_key, const LabelSet& classes);

/// `version`: of the map row's checksum, which covers the classes; 2 or later.
std::uint32_t ClassesChecksum(const std::vector<ClassRow>& rows, int version);

/// DATA_LOSS unless they form a label set.
Result<std::shared_ptr<const LabelSet>> LabelSetOf(const std::vector<ClassRow>& rows);

}  // namespace dhpmap

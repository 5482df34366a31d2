// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/class_rows.h"

#include <utility>

#include "storage/sqlite/database.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadClassesTask[] = "read a map's label set";
constexpr char kWriteClassesTask[] = "write a map's label set";

}  // namespace

const Table<ClassRow>& Classes() {
  static const Table<ClassRow> table("label_classes", ClassColumns());
  return table;
}

Result<std::vector<ClassRow>> ReadClassRows(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare(Classes().Select("WHERE map_key = ? ORDER BY class_id"), kReadClassesTask));
  select.Bind(map_key);
  std::vector<ClassRow> rows;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return rows;
    if (!Classes().Read(select, rows.emplace_back())) return DataLoss("its label set is damaged");
  }
}

Result<std::vector<ClassRow>> WriteClassRows(Database& database, std::int64_t map_key, const LabelSet& classes) {
  DHPMAP_ASSIGN_OR_RETURN(Statement clear,
                          database.Prepare("DELETE FROM label_classes WHERE map_key = ?", kWriteClassesTask));
  DHPMAP_RETURN_IF_ERROR(clear.Bind(map_key).Run());
  DHPMAP_ASSIGN_OR_RETURN(Statement insert, database.Prepare(Classes().Insert(), kWriteClassesTask));
  std::vector<ClassRow> rows;
  for (const LabelClass& label : classes.classes()) {
    const ClassRow& row = rows.emplace_back(ClassRow{map_key, label});
    Classes().BindAll(row, insert);
    DHPMAP_RETURN_IF_ERROR(insert.Run());
  }
  return rows;
}

std::uint32_t ClassesChecksum(const std::vector<ClassRow>& rows, int version) {
  Bytes bytes;
  for (const ClassRow& row : rows) Classes().Cover(row, version, bytes);
  return Crc32c(bytes);
}

Result<std::shared_ptr<const LabelSet>> LabelSetOf(const std::vector<ClassRow>& rows) {
  std::vector<LabelClass> classes;
  for (const ClassRow& row : rows) classes.push_back(row.label);
  Result<LabelSet> label_set = LabelSet::Create(std::move(classes));
  if (!label_set.ok()) return DataLoss("its label set is damaged: " + label_set.status().message());
  return std::make_shared<const LabelSet>(std::move(label_set).value());
}

}  // namespace dhpmap

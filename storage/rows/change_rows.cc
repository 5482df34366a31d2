// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/change_rows.h"

#include "storage/sqlite/database.h"

namespace dhpmap {

const Table<ChangeRow>& Changes() {
  static const Table<ChangeRow> table("changes", ChangeColumns());
  return table;
}

const Table<ChangeLogRow>& ChangeLogs() {
  static const Table<ChangeLogRow> table("change_logs", ChangeLogColumns());
  return table;
}

Result<std::optional<ChangeLogRow>> ReadChangeLog(sqlite::Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(sqlite::Statement select, database.Prepare(ChangeLogs().Select("WHERE map_key = ?"),
                                                                     "read how far a map's changes go back"));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(map_key).Step());
  if (!has_row) return std::optional<ChangeLogRow>();
  ChangeLogRow row;
  if (!ChangeLogs().Read(select, row) || !ChangeLogs().IsIntact(row, row.seal)) {
    return DataLoss("what is kept of its changes is damaged");
  }
  return std::optional<ChangeLogRow>(row);
}

}  // namespace dhpmap

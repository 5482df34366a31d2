// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "storage/check/sqlite_history.h"
#include "storage/codec/edit_codec.h"
#include "storage/rows/edit_rows.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kRepairHistoryTask[] = "repair what was changed";

Status Delete(Database& database, const char* sql, const std::vector<std::int64_t>& keys) {
  DHPMAP_ASSIGN_OR_RETURN(Statement erase, database.Prepare(sql, kRepairHistoryTask));
  for (const std::int64_t key : keys) DHPMAP_RETURN_IF_ERROR(erase.Bind(key).Run());
  return Status::Ok();
}

/// Says of each edit that is left what the log says that was undone or done again.
Status NoteTargets(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare(Edits().Select("WHERE map_key = ?"), kRepairHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement insert,
      database.Prepare(
          "INSERT OR REPLACE INTO edit_targets (map_key, target, revision, kind) SELECT map_key, revision, "
          "?, ? FROM edits WHERE map_key = ? AND revision = ?",
          kRepairHistoryTask));
  select.Bind(map_key);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status::Ok();
    EditRow row;
    EditEntry entry;
    if (!Edits().Read(select, row)) continue;
    entry.revision = row.revision;
    if (!DecodeEditSummary(row.summary.bytes, entry).ok()) continue;
    for (const std::int64_t target : entry.summary.targets) {
      insert.Bind(row.revision).Bind(static_cast<std::int64_t>(row.kind)).Bind(map_key).Bind(target);
      DHPMAP_RETURN_IF_ERROR(insert.Run());
    }
  }
}

Status NoteTotals(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(const EditTotals totals, SqliteHistory(database, map_key).CountEdits());
  DHPMAP_ASSIGN_OR_RETURN(Statement insert,
                          database.Prepare("INSERT OR REPLACE INTO edit_totals (map_key, num_edits, edit_bytes, "
                                           "num_histories, history_bytes) VALUES (?, ?, ?, ?, ?)",
                                           kRepairHistoryTask));
  insert.Bind(map_key);
  for (const std::int64_t total : totals) insert.Bind(total);
  return insert.Run();
}

}  // namespace

Status RepairHistory(Database& database, std::int64_t map_key, const BadHistory& bad, bool is_state_changed) {
  DHPMAP_RETURN_IF_ERROR(Delete(database, "DELETE FROM edits WHERE edit_key = ?", bad.edits));
  DHPMAP_RETURN_IF_ERROR(Delete(database, "DELETE FROM edit_histories WHERE edit_key = ?", bad.undos));
  if (is_state_changed) {
    DHPMAP_RETURN_IF_ERROR(Delete(database,
                                  "DELETE FROM edit_histories WHERE edit_key IN (SELECT edit_key FROM edits WHERE "
                                  "map_key = ?)",
                                  {map_key}));
  }
  DHPMAP_RETURN_IF_ERROR(Delete(database,
                                "DELETE FROM edit_targets WHERE map_key = ?1 AND target NOT IN (SELECT revision FROM "
                                "edits WHERE map_key = ?1)",
                                {map_key}));
  DHPMAP_RETURN_IF_ERROR(NoteTargets(database, map_key));
  return NoteTotals(database, map_key);
}

}  // namespace dhpmap

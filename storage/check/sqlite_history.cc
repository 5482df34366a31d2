// SPDX-License-Identifier: BSD-3-Clause
#include "storage/check/sqlite_history.h"

#include "storage/rows/change_rows.h"
#include "storage/rows/edit_rows.h"

namespace dhpmap {
namespace {

using sqlite::Columns;
using sqlite::Statement;

constexpr char kVerifyHistoryTask[] = "verify what was changed";

/// Steps through a statement whose parameters are bound.
template <typename Visit>
Status ForEachRow(Statement& select, Visit&& visit) {
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return Status::Ok();
    Status visited = visit();
    if (visited.ok()) continue;
    select.Reset();
    return visited;
  }
}

}  // namespace

Result<std::optional<ChangeLogRow>> SqliteHistory::ReadChangeLog() {
  return dhpmap::ReadChangeLog(database_, map_key_);
}

Status SqliteHistory::ForEachChange(const VisitChange& visit) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database_.Prepare(Changes().Select("WHERE map_key = ? ORDER BY last_revision"), kVerifyHistoryTask));
  select.Bind(map_key_);
  return ForEachRow(select, [&]() -> Status {
    ChangeRow row;
    const bool is_read = Changes().Read(select, row);
    return visit(row, is_read);
  });
}

Status SqliteHistory::ForEachEdit(const VisitEdit& visit) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database_.Prepare(Edits().Select("WHERE map_key = ? ORDER BY revision"), kVerifyHistoryTask));
  select.Bind(map_key_);
  return ForEachRow(select, [&]() -> Status {
    EditRow row;
    const bool is_read = Edits().Read(select, row);
    return visit(row, is_read);
  });
}

Result<bool> SqliteHistory::LacksTarget(std::int64_t target, const EditRow& edit) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement find,
      database_.Prepare("SELECT (SELECT count(*) FROM edits WHERE map_key = ?1 AND revision = ?2), (SELECT count(*) "
                        "FROM edit_targets WHERE map_key = ?1 AND target = ?2 AND revision = ?3 AND kind = ?4)",
                        kVerifyHistoryTask));
  find.Bind(map_key_).Bind(target).Bind(edit.revision).Bind(static_cast<std::int64_t>(edit.kind));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, find.Step());
  return has_row && find.Int(0) != 0 && find.Int(1) == 0;
}

Status SqliteHistory::ForEachHistory(const VisitHistory& visit) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database_.Prepare(
          EditHistories().Select("WHERE edit_key IN (SELECT edit_key FROM edits WHERE map_key = ?) ORDER BY edit_key"),
          kVerifyHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement find,
                          database_.Prepare("SELECT revision FROM edits WHERE edit_key = ?", kVerifyHistoryTask));
  select.Bind(map_key_);
  return ForEachRow(select, [&]() -> Status {
    EditHistoryRow row;
    const bool is_read = EditHistories().Read(select, row);
    DHPMAP_ASSIGN_OR_RETURN(const bool is_there, find.Bind(row.key).Step());
    const std::int64_t revision = is_there ? find.Int(0) : 0;
    find.Reset();
    return visit(row, is_read, revision);
  });
}

Status SqliteHistory::ForEachEditTile(const EditHistoryRow& history, const VisitEditTile& visit) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database_.Prepare("SELECT submap_id, x, y, z, layer, before_key, after_key, b.blob_key IS NULL, a.blob_key IS "
                        "NULL, b.blob, a.blob FROM edit_tiles LEFT JOIN tile_blobs b ON b.blob_key = before_key LEFT "
                        "JOIN tile_blobs a ON a.blob_key = after_key WHERE edit_key = ? ORDER BY submap_id, x, y, z, "
                        "layer",
                        kVerifyHistoryTask));
  select.Bind(history.key);
  return ForEachRow(select, [&]() -> Status {
    Columns columns(select);
    EditTileToVerify tile{.row = ReadEditTileRow(columns)};
    tile.lacks_before = columns.Int() != 0;
    tile.lacks_after = columns.Int() != 0;
    tile.row.before = columns.Blob();
    tile.row.after = columns.Blob();
    return visit(tile);
  });
}

Status SqliteHistory::ForEachLostTarget(const VisitTarget& visit) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database_.Prepare("SELECT target, revision FROM edit_targets t WHERE map_key = ? AND NOT EXISTS (SELECT 1 FROM "
                        "edits e WHERE e.map_key = t.map_key AND e.revision = t.target) ORDER BY 1, 2",
                        kVerifyHistoryTask));
  select.Bind(map_key_);
  return ForEachRow(select, [&] { return visit(select.Int(0), select.Int(1)); });
}

Result<EditTotals> SqliteHistory::CountEdits() {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database_.Prepare(
          "SELECT e.n, e.bytes, h.n, h.bytes FROM (SELECT count(*) AS n, ifnull(sum(64 + length(author) + "
          "length(request_id) + length(summary) + length(answer)), 0) AS bytes FROM edits WHERE map_key = "
          "?) e, (SELECT count(*) AS n, ifnull(sum(num_bytes), 0) AS bytes FROM edit_histories WHERE "
          "map_key = ?) h",
          kVerifyHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(map_key_).Bind(map_key_).Step());
  if (!has_row) return Internal("counting the edits gave no row");
  return EditTotals{select.Int(0), select.Int(1), select.Int(2), select.Int(3)};
}

Result<EditTotals> SqliteHistory::NotedEdits() {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database_.Prepare("SELECT num_edits, edit_bytes, num_histories, "
                                                              "history_bytes FROM edit_totals WHERE map_key = ?",
                                                              kVerifyHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(map_key_).Step());
  if (!has_row) return EditTotals{};
  return EditTotals{select.Int(0), select.Int(1), select.Int(2), select.Int(3)};
}

}  // namespace dhpmap

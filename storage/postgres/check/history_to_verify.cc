// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/check/history_to_verify.h"

#include <limits>

#include "storage/postgres/history/change_writes.h"
#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kVerifyHistoryTask[] = "verify what was changed";
const std::string kLacksTarget =
    "SELECT EXISTS (SELECT 1 FROM edits WHERE map_key = $1 AND revision = $2) AND NOT EXISTS (SELECT 1 FROM "
    "edit_targets "
    "WHERE map_key = $1 AND target = $2 AND revision = $3 AND kind = $4)";
const std::string kTilesToVerify =
    "SELECT t.submap_id, t.x, t.y, t.z, t.layer, t.before_key, t.after_key, b.blob_key IS NULL, a.blob_key IS NULL, "
    "coalesce(b.blob, ''), coalesce(a.blob, '') FROM edit_tiles t LEFT JOIN tile_blobs b ON b.map_key = t.map_key AND "
    "b.blob_key = t.before_key LEFT JOIN tile_blobs a ON a.map_key = t.map_key AND a.blob_key = t.after_key WHERE "
    "t.map_key = $1 AND t.edit_key = $2 ORDER BY t.submap_id, t.x, t.y, t.z, t.layer";
const std::string kLostTargets =
    "SELECT target, revision FROM edit_targets t WHERE map_key = $1 AND NOT EXISTS (SELECT 1 FROM edits e WHERE "
    "e.map_key = t.map_key AND e.revision = t.target) ORDER BY 1, 2";
const std::string kCountEdits =
    "SELECT e.n, e.bytes, h.n, h.bytes FROM (SELECT count(*) AS n, coalesce(sum(64 + octet_length(author) + "
    "octet_length(request_id) + octet_length(summary) + octet_length(answer)), 0)::bigint AS bytes FROM edits WHERE "
    "map_key = $1) e, (SELECT count(*) AS n, coalesce(sum(num_bytes), 0)::bigint AS bytes FROM edit_histories WHERE "
    "map_key = $1) h";
const std::string kNotedEdits =
    "SELECT num_edits, edit_bytes, num_histories, history_bytes FROM edit_totals WHERE map_key = $1";

/// Visits rows by ascending key, in batches, so that the visitor may use the same connection. `text`: at most $3 rows
/// of map $1 with keys above $2. `key` returns the key of a row. `visit` gets each row, and whether it could be read.
template <typename Row, typename KeyOf, typename Visit>
Status ForEachBySome(Connection& connection, std::int64_t map_key, const Table<Row>& table, const std::string& text,
                     std::int64_t rows_a_time, KeyOf&& key, Visit&& visit) {
  std::int64_t last = std::numeric_limits<std::int64_t>::min();
  for (;;) {
    Call call{&text};
    call.values.Add(map_key).Add(last).Add(rows_a_time);
    DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kVerifyHistoryTask));
    if (answer.num_rows() == 0) return Status::Ok();
    while (answer.Next()) {
      Row row;
      const bool is_read = ReadRow(table, answer, row);
      last = key(row);
      DHPMAP_RETURN_IF_ERROR(visit(row, is_read));
    }
  }
}

}  // namespace

Result<std::optional<ChangeLogRow>> HistoryToVerify::ReadChangeLog() {
  Call call{&LogOfChanges()};
  call.values.Add(map_key_);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection_.Query(call, kVerifyHistoryTask));
  if (!answer.Next()) return std::optional<ChangeLogRow>();
  ChangeLogRow log;
  if (ReadRow(ChangeLogs(), answer, log) && ChangeLogs().IsIntact(log, log.seal)) return std::optional(log);
  return DataLoss("the log of changes has a wrong checksum");
}

Status HistoryToVerify::ForEachChange(const VisitChange& visit) {
  static const std::string text =
      SelectText(Changes(), "WHERE map_key = $1 AND last_revision > $2 ORDER BY last_revision LIMIT $3");
  constexpr std::int64_t kChangesATime = 64;
  return ForEachBySome(
      connection_, map_key_, Changes(), text, kChangesATime, [](const ChangeRow& row) { return row.last_revision; },
      visit);
}

Status HistoryToVerify::ForEachEdit(const VisitEdit& visit) {
  static const std::string text =
      SelectText(Edits(), "WHERE map_key = $1 AND revision > $2 ORDER BY revision LIMIT $3");
  constexpr std::int64_t kEditsATime = 256;
  return ForEachBySome(
      connection_, map_key_, Edits(), text, kEditsATime, [](const EditRow& row) { return row.revision; },
      [&visit](EditRow& row, bool is_read) {
        row.key = row.revision;
        return visit(row, is_read);
      });
}

Result<bool> HistoryToVerify::LacksTarget(std::int64_t target, const EditRow& edit) {
  Call call{&kLacksTarget};
  call.values.Add(map_key_).Add(target).Add(edit.revision).Add(static_cast<std::int64_t>(edit.kind));
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection_.Query(call, kVerifyHistoryTask));
  return answer.Next() && answer.Int() != 0;
}

Status HistoryToVerify::ForEachHistory(const VisitHistory& visit) {
  static const std::string text = SelectText(EditHistories(),
                                             "WHERE map_key = $1 AND edit_key > $2 AND edit_key IN (SELECT e.revision "
                                             "FROM edits e WHERE e.map_key = $1) ORDER BY edit_key LIMIT $3");
  constexpr std::int64_t kHistoriesATime = 4;  // some have megabytes
  return ForEachBySome(
      connection_, map_key_, EditHistories(), text, kHistoriesATime, [](const EditHistoryRow& row) { return row.key; },
      [&visit](const EditHistoryRow& row, bool is_read) { return visit(row, is_read, row.key); });
}

Status HistoryToVerify::ForEachEditTile(const EditHistoryRow& history, const VisitEditTile& visit) {
  Call call{&kTilesToVerify};
  call.values.Add(map_key_).Add(history.key);
  return connection_.Stream(call, kVerifyHistoryTask, [&visit](Answer& answer) {
    EditTileToVerify tile{.row = ReadEditTileRow(answer)};
    tile.lacks_before = answer.Int() != 0;
    tile.lacks_after = answer.Int() != 0;
    tile.row.before = answer.Blob();
    tile.row.after = answer.Blob();
    return visit(tile);
  });
}

Status HistoryToVerify::ForEachLostTarget(const VisitTarget& visit) {
  Call call{&kLostTargets};
  call.values.Add(map_key_);
  return connection_.Stream(call, kVerifyHistoryTask, [&visit](Answer& answer) {
    const std::int64_t target = answer.Int();
    return visit(target, answer.Int());
  });
}

Result<EditTotals> HistoryToVerify::TotalsBy(const std::string& text) {
  Call call{&text};
  call.values.Add(map_key_);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection_.Query(call, kVerifyHistoryTask));
  EditTotals totals{};
  if (!answer.Next()) return totals;
  for (std::int64_t& total : totals) total = answer.Int();
  return totals;
}

Result<EditTotals> HistoryToVerify::CountEdits() { return TotalsBy(kCountEdits); }
Result<EditTotals> HistoryToVerify::NotedEdits() { return TotalsBy(kNotedEdits); }

}  // namespace dhpmap::postgres

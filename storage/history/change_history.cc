// SPDX-License-Identifier: BSD-3-Clause
#include "storage/history/change_history.h"

#include <memory>
#include <optional>
#include <utility>

#include "storage/codec/change_codec.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadChangesTask[] = "read what was changed";
constexpr char kWriteChangesTask[] = "write what was changed";
constexpr char kTrimChangesTask[] = "delete what was changed long ago";

/// Limit of changes trimmed in one commit, which adds one.
constexpr std::int64_t kMostChangesTrimmed = 16;

/// The log to which the change is appended.
Result<ChangeLogRow> LogBefore(Database& database, std::int64_t map_key, const MapInfo& info, const MapChange& change) {
  const auto stored = ReadChangeLog(database, map_key);
  const std::int64_t before = change.first_revision - 1;
  if (!stored.ok() && stored.status().code() != StatusCode::kDataLoss) return stored.status();
  const bool goes_on =
      stored.ok() && *stored && (*stored)->history_id == info.history_id && (*stored)->last_revision <= before;
  if (goes_on) return **stored;
  DHPMAP_ASSIGN_OR_RETURN(Statement erase, database.Prepare("DELETE FROM changes WHERE map_key = ?", kTrimChangesTask));
  DHPMAP_RETURN_IF_ERROR(erase.Bind(map_key).Run());
  return ChangeLogRow{
      .map_key = map_key, .history_id = info.history_id, .complete_after = before, .last_revision = before, .seal = {}};
}

Status InsertChange(Database& database, const MapChange& change, Bytes blob, std::int64_t now_ns,
                    const ChangeLogRow& log) {
  const ChangeRow row = ChangeRowOf(change, std::move(blob), now_ns, log);
  // A damaged row may have the same number.
  DHPMAP_ASSIGN_OR_RETURN(Statement upsert, database.Prepare(Changes().Upsert(), kWriteChangesTask));
  Changes().BindAll(row, upsert);
  return upsert.Run();
}

/// Deletes the oldest changes that exceed the limits or are not part of the log.
Status TrimChanges(Database& database, std::int64_t now_ns, const ChangeHistoryLimits& limits, ChangeLogRow& log) {
  DHPMAP_ASSIGN_OR_RETURN(Statement oldest,
                          database.Prepare("SELECT change_key, last_revision, seen_ns, length(blob) FROM changes "
                                           "WHERE map_key = ? ORDER BY last_revision LIMIT 1",
                                           kTrimChangesTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase,
                          database.Prepare("DELETE FROM changes WHERE change_key = ?", kTrimChangesTask));
  for (std::int64_t n = 0; n < kMostChangesTrimmed; ++n) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, oldest.Bind(log.map_key).Step());
    if (!has_row) return Status::Ok();
    const std::int64_t key = oldest.Int(0), revision = oldest.Int(1), seen_ns = oldest.Int(2), bytes = oldest.Int(3);
    oldest.Reset();
    const bool is_left_out = revision <= log.complete_after;
    if (!is_left_out && !IsBeyond(limits, {log.num_changes, log.num_bytes}, seen_ns, now_ns)) return Status::Ok();
    DHPMAP_RETURN_IF_ERROR(erase.Bind(key).Run());
    if (!is_left_out) log.complete_after = revision;
    --log.num_changes;
    log.num_bytes -= bytes;
  }
  return Status::Ok();
}

/// Reads consecutive rows that follow `after`.
Status ReadChangeRows(Database& database, const MapRow& map, const ChangeLogRow& log, std::int64_t after,
                      std::size_t max_bytes, ChangeList& list) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare(
          Changes().Select("WHERE map_key = ? AND last_revision > ? AND last_revision <= ? ORDER BY last_revision"),
          kReadChangesTask));
  select.Bind(map.key).Bind(after).Bind(log.last_revision);
  std::int64_t previous = after;
  for (std::size_t num_bytes = 0; num_bytes < max_bytes;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return previous >= log.last_revision ? Status::Ok() : DamagedChanges(map.info.name, previous);
    ChangeRow row;
    const bool is_read = Changes().Read(select, row);
    DHPMAP_ASSIGN_OR_RETURN(auto change, ChangeOf(is_read, row, map.info.name, {previous, list.changes.empty()}));
    num_bytes += BytesOf(*change);
    list.changes.push_back(std::move(change));
    previous = row.last_revision;
  }
  list.has_more = previous < log.last_revision;
  select.Reset();
  return Status::Ok();
}

}  // namespace

Status RecordChange(Database& database, std::int64_t map_key, const MapInfo& info, const MapChange& change,
                    std::int64_t now_ns, const ChangeHistoryLimits& limits) {
  DHPMAP_ASSIGN_OR_RETURN(ChangeLogRow log, LogBefore(database, map_key, info, change));
  Bytes blob = EncodeChange(change);
  const auto num_bytes = static_cast<std::int64_t>(blob.size());
  if (num_bytes > limits.max_bytes) {
    log.complete_after = change.last_revision;  // it does not fit, so earlier changes are useless, too
  } else {
    DHPMAP_RETURN_IF_ERROR(InsertChange(database, change, std::move(blob), now_ns, log));
    ++log.num_changes;
    log.num_bytes += num_bytes;
  }
  log.last_revision = change.last_revision;
  DHPMAP_RETURN_IF_ERROR(TrimChanges(database, now_ns, limits, log));
  log.seal = ChangeLogs().SealOf(log);
  DHPMAP_ASSIGN_OR_RETURN(Statement upsert, database.Prepare(ChangeLogs().Upsert(), kWriteChangesTask));
  ChangeLogs().BindAll(log, upsert);
  return upsert.Run();
}

Status ForgetChanges(Database& database, std::int64_t map_key) {
  for (const char* sql : {"DELETE FROM changes WHERE map_key = ?", "DELETE FROM change_logs WHERE map_key = ?"}) {
    DHPMAP_ASSIGN_OR_RETURN(Statement erase, database.Prepare(sql, kWriteChangesTask));
    DHPMAP_RETURN_IF_ERROR(erase.Bind(map_key).Run());
  }
  return Status::Ok();
}

Result<ChangeList> ReadChanges(Database& database, const MapRow& map, std::int64_t after_revision,
                               std::size_t max_bytes) {
  ChangeList list{
      .history_id = map.info.history_id, .revision = map.info.revision, .complete_after = map.info.revision};
  const auto stored = ReadChangeLog(database, map.key);
  if (stored.status().code() == StatusCode::kDataLoss) return DamagedChanges(map.info.name, after_revision);
  if (!stored.ok()) return stored.status();
  const bool has_log = *stored && (*stored)->history_id == map.info.history_id;
  if (has_log) list.complete_after = (*stored)->complete_after;
  if (has_log && (*stored)->last_revision > list.revision) return DamagedChanges(map.info.name, after_revision);
  if (after_revision < list.complete_after) return ChangesNotKept(list.complete_after);
  if (has_log) DHPMAP_RETURN_IF_ERROR(ReadChangeRows(database, map, **stored, after_revision, max_bytes, list));
  return list;
}

}  // namespace dhpmap

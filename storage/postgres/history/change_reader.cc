// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/history/change_reader.h"

#include <utility>

#include "storage/history/logged_change.h"
#include "storage/postgres/history/change_writes.h"
#include "storage/postgres/reading/head_reader.h"
#include "storage/postgres/reading/one_state.h"
#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadChangesTask[] = "read what was changed";

Result<std::optional<ChangeLogRow>> ReadLog(Connection& connection, const MapRow& map, std::int64_t after_revision) {
  Call call{&LogOfChanges()};
  call.values.Add(map.key);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadChangesTask));
  if (!answer.Next()) return std::optional<ChangeLogRow>();
  ChangeLogRow log;
  const bool is_intact = ReadRow(ChangeLogs(), answer, log) && ChangeLogs().IsIntact(log, log.seal);
  if (!is_intact || (log.history_id == map.info.history_id && log.last_revision > map.info.revision)) {
    return DamagedChanges(map.info.name, after_revision);
  }
  return log.history_id == map.info.history_id ? std::optional(log) : std::nullopt;
}

/// Reads some rows after `previous`, each following the one before.
Status ReadSome(Connection& connection, const MapRow& map, const ChangeLogRow& log, std::int64_t& previous,
                std::size_t max_bytes, std::size_t& num_bytes, ChangeList& list) {
  static const std::string text = SelectText(
      Changes(), "WHERE map_key = $1 AND last_revision > $2 AND last_revision <= $3 ORDER BY last_revision LIMIT $4");
  constexpr std::int64_t kRowsATime = 64;
  Call call{&text};
  call.values.Add(map.key).Add(previous).Add(log.last_revision).Add(kRowsATime);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadChangesTask));
  if (answer.num_rows() == 0) return DamagedChanges(map.info.name, previous);
  while (num_bytes < max_bytes && answer.Next()) {
    ChangeRow row;
    const bool is_read = ReadRow(Changes(), answer, row);
    DHPMAP_ASSIGN_OR_RETURN(auto change, ChangeOf(is_read, row, map.info.name, {previous, list.changes.empty()}));
    num_bytes += BytesOf(*change);
    list.changes.push_back(std::move(change));
    previous = row.last_revision;
  }
  return Status::Ok();
}

}  // namespace

Result<ChangeList> ReadChangeList(Connection& connection, const std::string& name, std::int64_t after_revision,
                                  std::size_t max_bytes) {
  DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
  DHPMAP_ASSIGN_OR_RETURN(const MapHead head, ReadHeadOf(connection, name));
  const MapRow& map = head.row;
  DHPMAP_ASSIGN_OR_RETURN(const auto log, ReadLog(connection, map, after_revision));
  ChangeList list{
      .history_id = map.info.history_id, .revision = map.info.revision, .complete_after = map.info.revision};
  if (log) list.complete_after = log->complete_after;
  if (after_revision < list.complete_after) return ChangesNotKept(list.complete_after);
  if (!log) return list;
  std::int64_t previous = after_revision;
  for (std::size_t num_bytes = 0; previous < log->last_revision && num_bytes < max_bytes;) {
    DHPMAP_RETURN_IF_ERROR(ReadSome(connection, map, *log, previous, max_bytes, num_bytes, list));
  }
  list.has_more = previous < log->last_revision;
  return list;
}

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/history/history_reader.h"

#include <limits>
#include <utility>

#include "storage/codec/edit_codec.h"
#include "storage/history/edit_tiles.h"
#include "storage/history/logged_change.h"
#include "storage/history/logged_edit.h"
#include "storage/postgres/history/change_writes.h"
#include "storage/postgres/reading/map_reader.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/postgres/rows/table_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadChangesTask[] = "read what was changed";
constexpr char kReadEditsTask[] = "read the log of edits";

/// What is beside a row of the edit log.
struct EditMarks {
  bool is_undone = false, is_kept = false;
};

Result<MapHead> ReadHeadOf(Connection& connection, const std::string& name) {
  Call call{&HeadByName()};
  call.values.Add(name);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, "read the map"));
  if (!answer.Next()) return NoSuchMap(name);
  MapHead head;
  if (!ReadHead(answer, head)) return DamagedRows(name, "its row has a wrong checksum");
  return head;
}

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

/// Some rows after `previous`, each of which follows the one before.
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

std::string EditsText(const char* which) {
  const std::string marks =
      "(SELECT t.kind FROM edit_targets t WHERE t.map_key = edits.map_key AND t.target = edits.revision ORDER BY "
      "t.revision DESC LIMIT 1)";
  const std::string kept =
      "EXISTS (SELECT 1 FROM edit_histories h WHERE h.map_key = edits.map_key AND h.edit_key = edits.revision)";
  return SelectText(Edits(), which, {"coalesce(" + marks + ", -1)", kept});
}

Result<EditRow> EditAt(Answer& answer, const std::string& map, EditMarks& marks) {
  EditRow row;
  const bool is_read = ReadRow(Edits(), answer, row);
  marks.is_undone = answer.Int() == static_cast<std::int64_t>(EditKind::kUndo);
  marks.is_kept = answer.Int() != 0;
  DHPMAP_RETURN_IF_ERROR(CheckEdit(is_read, row, map));
  return row;
}

Status ReadDeltaTiles(Connection& connection, const MapRow& map, const EditHistoryRow& history, std::uint16_t store,
                      StateDelta& delta) {
  static const std::string text =
      "SELECT t.submap_id, t.x, t.y, t.z, t.layer, t.before_key, t.after_key, b.blob, a.blob FROM edit_tiles t LEFT "
      "JOIN "
      "tile_blobs b ON b.map_key = t.map_key AND b.blob_key = t.before_key LEFT JOIN tile_blobs a ON a.map_key = "
      "t.map_key AND a.blob_key = t.after_key WHERE t.map_key = $1 AND t.edit_key = $2 ORDER BY t.submap_id, t.x, t.y, "
      "t.z, t.layer";
  Call call{&text};
  call.values.Add(map.key).Add(history.key);
  TileTotals totals;
  DHPMAP_RETURN_IF_ERROR(connection.Stream(call, kReadEditsTask, [&](Answer& answer) -> Status {
    EditTileRow row = ReadEditTileRow(answer);
    row.before = answer.Blob();
    row.after = answer.Blob();
    AddEditTile(totals, row.submap_id, row.index, row.layer, row.before_key, row.after_key);
    const Status added = AddEditTileTo(row, store, delta);
    return added.ok() ? Status::Ok() : DamagedHistory(map, history.revision, added.message());
  }));
  return totals.sum == history.tiles_sum ? Status::Ok() : DamagedHistory(map, history.revision, "lacks tiles");
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

Result<std::vector<LoggedEdit>> ReadEditLog(Connection& connection, const std::string& name, const EditQuery& query) {
  static const std::string all = EditsText("WHERE map_key = $1 AND revision < $2 ORDER BY revision DESC LIMIT $3");
  static const std::string of_author =
      EditsText("WHERE map_key = $1 AND revision < $2 AND author = $4 ORDER BY revision DESC LIMIT $3");
  DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
  DHPMAP_ASSIGN_OR_RETURN(const MapHead head, ReadHeadOf(connection, name));
  Call call{query.author ? &of_author : &all};
  call.values.Add(head.row.key).Add(query.before_revision.value_or(std::numeric_limits<std::int64_t>::max()));
  call.values.Add(query.max_edits);
  if (query.author) call.values.Add(*query.author);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadEditsTask));
  std::vector<LoggedEdit> edits;
  while (answer.Next()) {
    EditMarks marks;
    DHPMAP_ASSIGN_OR_RETURN(const EditRow row, EditAt(answer, name, marks));
    DHPMAP_ASSIGN_OR_RETURN(LoggedEdit edit, LoggedEditOf(row, name));
    edit.is_undone = marks.is_undone;
    edit.is_kept = marks.is_kept;
    edits.push_back(std::move(edit));
  }
  return edits;
}

Result<std::optional<StoredAnswer>> ReadStoredAnswer(Connection& connection, const std::string& name,
                                                     const std::string& request_id) {
  static const std::string text =
      EditsText("WHERE map_key = $1 AND request_id = $2 AND request_id <> '' ORDER BY revision DESC LIMIT 1");
  DHPMAP_ASSIGN_OR_RETURN(const MapHead head, ReadHeadOf(connection, name));
  Call call{&text};
  call.values.Add(head.row.key).Add(request_id);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadEditsTask));
  if (!answer.Next()) return std::optional<StoredAnswer>();
  EditMarks marks;
  DHPMAP_ASSIGN_OR_RETURN(const EditRow row, EditAt(answer, name, marks));
  return std::optional(AnswerOf(row));
}

Result<StateDelta> ReadEditDelta(Connection& connection, const std::string& name, std::int64_t revision,
                                 std::uint16_t store) {
  static const std::string select = SelectText(EditHistories(), "WHERE map_key = $1 AND edit_key = $2");
  static const std::string is_logged = "SELECT 1 FROM edits WHERE map_key = $1 AND revision = $2";
  static const std::string oldest = "SELECT min(edit_key) FROM edit_histories WHERE map_key = $1 HAVING count(*) > 0";
  DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
  DHPMAP_ASSIGN_OR_RETURN(const MapHead head, ReadHeadOf(connection, name));
  const MapRow& map = head.row;
  std::vector<Call> calls = {{&is_logged}, {&select}, {&oldest}};
  for (Call& call : calls) call.values.Add(map.key);
  for (Call* call : {calls.data(), calls.data() + 1}) call->values.Add(revision);
  Answers got = connection.Run(calls, kReadEditsTask);
  if (!got.status.ok()) return got.status;
  if (!got.answers[0].Next()) {
    return NotFound("the log of the map has no edit " + std::to_string(revision)).WithReason("EDIT_NOT_FOUND");
  }
  if (!got.answers[1].Next()) {
    return UndoNotKept(revision, got.answers[2].Next() ? std::optional(got.answers[2].Int()) : std::nullopt);
  }
  EditHistoryRow row;
  const bool is_read = ReadRow(EditHistories(), got.answers[1], row);
  if (!is_read || !EditHistories().IsIntact(row, row.seal) || row.revision != revision) {
    return DamagedHistory(map, revision, "has a wrong checksum");
  }
  StateDelta delta;
  const Status decoded = DecodeEditRows(row.blob.bytes, revision, delta);
  if (!decoded.ok()) return DamagedHistory(map, revision, decoded.message());
  DHPMAP_RETURN_IF_ERROR(ReadDeltaTiles(connection, map, row, store, delta));
  return delta;
}

}  // namespace dhpmap::postgres

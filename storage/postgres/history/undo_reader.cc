// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/history/undo_reader.h"

#include <utility>
#include <vector>

#include "storage/codec/edit_codec.h"
#include "storage/history/edit_tiles.h"
#include "storage/history/logged_edit.h"
#include "storage/postgres/reading/head_reader.h"
#include "storage/postgres/reading/one_state.h"
#include "storage/postgres/rows/table_text.h"
#include "storage/rows/edit_rows.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadUndoTask[] = "read the log of edits";

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
  DHPMAP_RETURN_IF_ERROR(connection.Stream(call, kReadUndoTask, [&](Answer& answer) -> Status {
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
  Answers got = connection.Run(calls, kReadUndoTask);
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

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/history/edit_history.h"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "storage/codec/edit_codec.h"
#include "storage/rows/edit_rows.h"

namespace dhpmap {
namespace {

using sqlite::Columns;
using sqlite::Database;
using sqlite::Statement;

constexpr char kReadHistoryTask[] = "read what undoes an edit";
constexpr char kWriteHistoryTask[] = "write what undoes an edit";
constexpr char kTrimHistoryTask[] = "delete what undoes edits of long ago";

/// Limit of undo histories trimmed with one edit.
constexpr int kMostHistoriesTrimmed = 16;
EditTileRow RowAt(const Statement& statement) {
  Columns columns(statement);
  return ReadEditTileRow(columns);
}

Result<std::optional<std::int64_t>> OldestKept(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT revision FROM edit_histories WHERE map_key = ? ORDER BY revision LIMIT 1",
                       kReadHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(map_key).Step());
  return has_row ? std::optional(select.Int(0)) : std::nullopt;
}

Status ReadTiles(Database& database, const MapRow& map, const EditHistoryRow& history, std::uint16_t store,
                 StateDelta& delta) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT submap_id, x, y, z, layer, before_key, after_key, b.blob, a.blob FROM edit_tiles "
                       "LEFT JOIN tile_blobs b ON b.blob_key = before_key LEFT JOIN tile_blobs a ON a.blob_key = "
                       "after_key WHERE edit_key = ? ORDER BY submap_id, x, y, z, layer",
                       kReadHistoryTask));
  TileTotals totals;
  select.Bind(history.key);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) break;
    EditTileRow row = RowAt(select);
    row.before = select.Blob(7);
    row.after = select.Blob(8);
    AddEditTile(totals, row.submap_id, row.index, row.layer, row.before_key, row.after_key);
    const Status added = AddEditTileTo(row, store, delta);
    if (!added.ok()) return DamagedHistory(map, history.revision, added.message());
  }
  return totals.sum == history.tiles_sum ? Status::Ok() : DamagedHistory(map, history.revision, "lacks tiles");
}

}  // namespace

Result<EditTileRecorder> EditTileRecorder::Prepare(Database& database, std::int64_t edit_key) {
  EditTileRecorder recorder(edit_key);
  struct Text {
    OptionalStatement* statement;
    const char* sql;
  };
  const std::initializer_list<Text> texts = {
      {&recorder.insert_,
       "INSERT INTO edit_tiles (edit_key, submap_id, x, y, z, layer, before_key, after_key) VALUES (?, ?, ?, ?, ?, ?, "
       "?, ?)"},
      {&recorder.share_,
       "INSERT INTO shared_blobs (blob_key, num_more) VALUES (?, 1) ON CONFLICT (blob_key) DO UPDATE SET num_more = "
       "num_more + 1"},
      {&recorder.note_new_,
       "INSERT INTO edit_tiles SELECT ?, ?, x, y, z, layer, 0, blob_key FROM tiles WHERE owner_key = ?"},
      {&recorder.note_removed_,
       "INSERT INTO edit_tiles SELECT ?, ?, x, y, z, layer, blob_key, 0 FROM tiles WHERE owner_key = ?"},
      {&recorder.share_all_,
       "INSERT INTO shared_blobs (blob_key, num_more) SELECT blob_key, 1 FROM tiles WHERE owner_key = ? ON CONFLICT "
       "(blob_key) DO UPDATE SET num_more = num_more + 1"},
      {&recorder.rows_, "SELECT x, y, z, layer, blob_key FROM tiles WHERE owner_key = ?"},
      {&recorder.find_,
       "SELECT before_key, after_key FROM edit_tiles WHERE edit_key = ? AND submap_id = ? AND x = ? AND y = ? AND z = "
       "? "
       "AND layer = ?"},
      {&recorder.erase_,
       "DELETE FROM edit_tiles WHERE edit_key = ? AND submap_id = ? AND x = ? AND y = ? AND z = ? AND layer = ?"},
  };
  for (const Text& text : texts) {
    DHPMAP_ASSIGN_OR_RETURN(Statement statement, database.Prepare(text.sql, kWriteHistoryTask));
    text.statement->emplace(std::move(statement));
  }
  return recorder;
}

Status EditTileRecorder::Note(std::int64_t submap_id, TileIndex index, std::int64_t layer, const StoredBlob& before,
                              const StoredBlob& after) {
  if (before.key == after.key) return Status::Ok();
  if (goes_on_) {
    find_->Bind(edit_key_).Bind(submap_id).Bind(index.x).Bind(index.y).Bind(index.z).Bind(layer);
    DHPMAP_ASSIGN_OR_RETURN(const bool is_noted, find_->Step());
    if (is_noted) return NoteFurther(submap_id, index, layer, before, after);
    find_->Reset();
  }
  insert_->Bind(edit_key_).Bind(submap_id).Bind(index.x).Bind(index.y).Bind(index.z).Bind(layer);
  DHPMAP_RETURN_IF_ERROR(insert_->Bind(before.key).Bind(after.key).Run());
  for (const StoredBlob& blob : {before, after}) {
    if (blob.key != 0) DHPMAP_RETURN_IF_ERROR(share_->Bind(blob.key).Run());
  }
  AddEditTile(totals_, submap_id, index, layer, before.key, after.key);
  totals_.bytes += before.bytes + after.bytes + kEditTileBytes;
  return Status::Ok();
}

/// The existing row goes from before the edit to `between`; now it must go to `after`.
Status EditTileRecorder::NoteFurther(std::int64_t submap_id, TileIndex index, std::int64_t layer,
                                     const StoredBlob& between, const StoredBlob& after) {
  const std::int64_t before_key = find_->Int(0), between_key = find_->Int(1);
  find_->Reset();
  // Counted before the old row is deleted, so that no blob is temporarily unreferenced.
  for (const std::int64_t key : {before_key, after.key}) {
    if (key != 0) DHPMAP_RETURN_IF_ERROR(share_->Bind(key).Run());
  }
  erase_->Bind(edit_key_).Bind(submap_id).Bind(index.x).Bind(index.y).Bind(index.z).Bind(layer);
  DHPMAP_RETURN_IF_ERROR(erase_->Run());
  insert_->Bind(edit_key_).Bind(submap_id).Bind(index.x).Bind(index.y).Bind(index.z).Bind(layer);
  DHPMAP_RETURN_IF_ERROR(insert_->Bind(before_key).Bind(after.key).Run());
  TileTotals old;
  AddEditTile(old, submap_id, index, layer, before_key, between_key);
  AddEditTile(totals_, submap_id, index, layer, before_key, after.key);
  totals_.sum =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(totals_.sum) - static_cast<std::uint64_t>(old.sum));
  totals_.bytes += after.bytes - between.bytes;
  return Status::Ok();
}

Status EditTileRecorder::NoteNew(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes, bool is_counted) {
  DHPMAP_RETURN_IF_ERROR(NoteAll(Side::kAfter, id, owner_key, blob_bytes));
  return is_counted ? Status::Ok() : share_all_->Bind(owner_key).Run();
}

Status EditTileRecorder::NoteRemoved(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes) {
  DHPMAP_RETURN_IF_ERROR(NoteAll(Side::kBefore, id, owner_key, blob_bytes));
  return share_all_->Bind(owner_key).Run();
}

/// Touches rows only, and no page of a blob.
Status EditTileRecorder::NoteAll(Side side, SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes) {
  Statement& note = side == Side::kAfter ? *note_new_ : *note_removed_;
  DHPMAP_RETURN_IF_ERROR(note.Bind(edit_key_).Bind(std::int64_t{id.value}).Bind(owner_key).Run());
  totals_.bytes += blob_bytes;
  rows_->Bind(owner_key);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, rows_->Step());
    if (!has_row) return Status::Ok();
    Columns columns(*rows_);
    TileIndex index;
    for (std::int32_t* axis : {&index.x, &index.y, &index.z}) *axis = static_cast<std::int32_t>(columns.Int());
    const std::int64_t layer = columns.Int(), key = columns.Int();
    AddEditTile(totals_, id.value, index, layer, side == Side::kBefore ? key : 0, side == Side::kAfter ? key : 0);
    totals_.bytes += kEditTileBytes;
  }
}

Status RecordHistory(Database& database, std::int64_t map_key, std::int64_t edit_key, const EditRecord& edit,
                     const MapSnapshot& after, const EditTileRecorder& tiles) {
  const EditHistoryRow row = EditHistoryRowOf(map_key, edit_key, edit, after, {tiles.num_bytes(), tiles.tiles_sum()});
  DHPMAP_ASSIGN_OR_RETURN(Statement insert, database.Prepare(EditHistories().Insert(), kWriteHistoryTask));
  EditHistories().BindAll(row, insert);
  return insert.Run();
}

Result<std::optional<EditTileRecorder>> RecorderOfLeft(Database& database, const MapRow& map) {
  if (!map.leaving()) return std::optional<EditTileRecorder>();
  DHPMAP_ASSIGN_OR_RETURN(Statement find,
                          database.Prepare("SELECT edit_key FROM edit_histories WHERE edit_key = (SELECT edit_key FROM "
                                           "edits WHERE map_key = ? ORDER BY revision DESC LIMIT 1)",
                                           kReadHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool is_kept, find.Bind(map.key).Step());
  if (!is_kept) return std::optional<EditTileRecorder>();
  DHPMAP_ASSIGN_OR_RETURN(EditTileRecorder recorder, EditTileRecorder::Prepare(database, find.Int(0)));
  recorder.goes_on_ = true;
  return std::optional(std::move(recorder));
}

Status AddToHistory(Database& database, const EditTileRecorder& left, std::int64_t now_ns,
                    const EditLogLimits& limits) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare(EditHistories().Select("WHERE edit_key = ?"), kReadHistoryTask));
  DHPMAP_RETURN_IF_ERROR(select.Bind(left.edit_key()).Step().status());
  EditHistoryRow row;
  const bool is_intact = EditHistories().Read(select, row) && EditHistories().IsIntact(row, row.seal);
  select.Reset();
  if (!is_intact) return Status::Ok();  // leave it unreadable
  row.num_bytes += left.num_bytes();
  row.tiles_sum = static_cast<std::int64_t>(static_cast<std::uint64_t>(row.tiles_sum) +
                                            static_cast<std::uint64_t>(left.tiles_sum()));
  row.seal = EditHistories().SealOf(row);
  DHPMAP_ASSIGN_OR_RETURN(Statement update,
                          database.Prepare(EditHistories().Update("WHERE edit_key = ?"), kWriteHistoryTask));
  EditHistories().BindChanges(row, update);
  DHPMAP_RETURN_IF_ERROR(update.Bind(row.key).Run());
  DHPMAP_ASSIGN_OR_RETURN(Statement totals,
                          database.Prepare("UPDATE edit_totals SET history_bytes = history_bytes + ? WHERE map_key = ?",
                                           kWriteHistoryTask));
  DHPMAP_RETURN_IF_ERROR(totals.Bind(left.num_bytes()).Bind(row.map_key).Run());
  return TrimHistories(database, row.map_key, now_ns, limits);
}

Status TrimHistories(Database& database, std::int64_t map_key, std::int64_t now_ns, const EditLogLimits& limits) {
  DHPMAP_ASSIGN_OR_RETURN(Statement oversized,
                          database.Prepare("DELETE FROM edit_histories WHERE edit_key = (SELECT edit_key FROM "
                                           "edit_histories WHERE map_key = ? ORDER BY revision DESC LIMIT 1) AND "
                                           "num_bytes > ?",
                                           kTrimHistoryTask));
  DHPMAP_RETURN_IF_ERROR(oversized.Bind(map_key).Bind(limits.max_history_bytes).Run());
  DHPMAP_ASSIGN_OR_RETURN(Statement oldest,
                          database.Prepare("SELECT h.edit_key, e.seen_ns, num_histories, history_bytes FROM "
                                           "edit_histories h JOIN edits e USING (edit_key) JOIN edit_totals t ON "
                                           "t.map_key = h.map_key WHERE h.map_key = ? ORDER BY h.revision LIMIT 1",
                                           kTrimHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase,
                          database.Prepare("DELETE FROM edit_histories WHERE edit_key = ?", kTrimHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement count,
                          database.Prepare("SELECT count(*) FROM edit_tiles WHERE edit_key = ?", kTrimHistoryTask));
  std::int64_t num_tiles = 0;
  for (int n = 0; n < kMostHistoriesTrimmed && num_tiles < kMostTilesTrimmed; ++n) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, oldest.Bind(map_key).Step());
    if (!has_row) return Status::Ok();
    const std::int64_t key = oldest.Int(0);
    const bool is_beyond = oldest.Int(2) > limits.max_histories || oldest.Int(3) > limits.max_history_bytes ||
                           static_cast<double>(now_ns - oldest.Int(1)) > limits.max_history_age_s * 1e9;
    oldest.Reset();
    if (!is_beyond) return Status::Ok();
    DHPMAP_RETURN_IF_ERROR(count.Bind(key).Step().status());
    num_tiles += count.Int(0);
    count.Reset();
    if (n > 0 && num_tiles > kMostTilesTrimmed) return Status::Ok();
    DHPMAP_RETURN_IF_ERROR(erase.Bind(key).Run());
  }
  return Status::Ok();
}

Result<StateDelta> ReadHistory(Database& database, const MapRow& map, std::int64_t revision, std::uint16_t store) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement find,
      database.Prepare("SELECT edit_key FROM edits WHERE map_key = ? AND revision = ?", kReadHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool is_there, find.Bind(map.key).Bind(revision).Step());
  if (!is_there) {
    return NotFound("the log of the map has no edit " + std::to_string(revision)).WithReason("EDIT_NOT_FOUND");
  }
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          database.Prepare(EditHistories().Select("WHERE edit_key = ?"), kReadHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool is_kept, select.Bind(find.Int(0)).Step());
  if (!is_kept) {
    DHPMAP_ASSIGN_OR_RETURN(const auto oldest, OldestKept(database, map.key));
    return UndoNotKept(revision, oldest);
  }
  EditHistoryRow row;
  if (!EditHistories().Read(select, row) || !EditHistories().IsIntact(row, row.seal) || row.revision != revision) {
    return DamagedHistory(map, revision, "has a wrong checksum");
  }
  StateDelta delta;
  const Status decoded = DecodeEditRows(row.blob.bytes, revision, delta);
  if (!decoded.ok()) return DamagedHistory(map, revision, decoded.message());
  DHPMAP_RETURN_IF_ERROR(ReadTiles(database, map, row, store, delta));
  return delta;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/check/verify_history.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "storage/codec/change_codec.h"
#include "storage/codec/edit_codec.h"
#include "storage/codec/free_codec.h"
#include "storage/history/change_history.h"
#include "storage/history/edit_history.h"
#include "storage/rows/change_rows.h"
#include "storage/rows/edit_rows.h"
#include "storage/tiles/object_layers.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

using sqlite::Columns;
using sqlite::Database;
using sqlite::Statement;
using Kind = MapFault::Kind;

constexpr char kVerifyHistoryTask[] = "verify what was changed";
constexpr char kRepairHistoryTask[] = "repair what was changed";
constexpr char kWrongChecksum[] = "has a wrong checksum";

std::string EditName(std::int64_t revision) { return "edit " + std::to_string(revision); }

/// A row of edit_tiles, and one side of it.
struct EditTile {
  std::int64_t submap_id = 0;
  TileIndex index;
  std::int64_t layer = 0;

  [[nodiscard]] bool IsOfMap() const { return submap_id == kMapsOwnTiles; }
  [[nodiscard]] std::string Name() const {
    if (IsOfMap()) return NameOfTile("vacated", index);
    return TileName(static_cast<std::uint32_t>(submap_id), layer, index);
  }
  [[nodiscard]] Status Decode(ByteView blob) const {
    if (IsOfMap()) {
      FreeTile tile;
      return DecodeFreeTile(BlobKind::kVacatedV1, blob, index, tile);
    }
    BlockTile tile;
    return FindObjectLayer(layer)->decode(blob, index, tile);
  }
  [[nodiscard]] bool IsKnownLayer() const {
    return IsOfMap() ? layer == LayerNumber(BlobKind::kVacatedV1) : FindObjectLayer(layer) != nullptr;
  }
};

/// The content of edit_totals, counted anew.
using EditTotals = std::array<std::int64_t, 4>;

Result<EditTotals> CountEdits(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT e.n, e.bytes, h.n, h.bytes FROM (SELECT count(*) AS n, ifnull(sum(64 + length(author) + "
                       "length(request_id) + length(summary) + length(answer)), 0) AS bytes FROM edits WHERE map_key = "
                       "?) e, (SELECT count(*) AS n, ifnull(sum(num_bytes), 0) AS bytes FROM edit_histories WHERE "
                       "map_key = ?) h",
                       kVerifyHistoryTask));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(map_key).Bind(map_key).Step());
  if (!has_row) return Internal("counting the edits gave no row");
  return EditTotals{select.Int(0), select.Int(1), select.Int(2), select.Int(3)};
}

class HistoryVerifier {
 public:
  HistoryVerifier(Database& database, const MapRow& map, const std::function<Status()>& check_stop,
                  const FaultSink& fault)
      : database_(database), map_(map), check_stop_(check_stop), fault_(fault) {}

  Result<BadHistory> Run() {
    DHPMAP_RETURN_IF_ERROR(VerifyChanges());
    DHPMAP_RETURN_IF_ERROR(VerifyEdits());
    DHPMAP_RETURN_IF_ERROR(VerifyHistories());
    DHPMAP_RETURN_IF_ERROR(VerifyTargets());
    DHPMAP_RETURN_IF_ERROR(VerifyTotals());
    return std::move(bad_);
  }

 private:
  Status VerifyChanges() {
    const auto log = ReadChangeLog(database_, map_.key);
    if (log.status().code() == StatusCode::kDataLoss) {
      fault_(Kind::kRow, "changes", "are listed in a row that " + std::string(kWrongChecksum));
      return Status::Ok();
    }
    DHPMAP_RETURN_IF_ERROR(log.status());
    // Rows of another history are unused, and the next commit deletes them.
    if (!*log || (*log)->history_id != map_.info.history_id) return Status::Ok();
    return VerifyChanges(**log);
  }

  Status VerifyChanges(const ChangeLogRow& log) {
    if (log.last_revision > map_.info.revision) {
      fault_(Kind::kCount, "changes",
             "go on to revision " + std::to_string(log.last_revision) + ", beyond that of the map");
    }
    DHPMAP_ASSIGN_OR_RETURN(
        Statement select,
        database_.Prepare(Changes().Select("WHERE map_key = ? ORDER BY last_revision"), kVerifyHistoryTask));
    select.Bind(map_.key);
    ChangeTotals totals;
    std::int64_t previous = log.complete_after;
    bool is_first = true;
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
      if (!has_row) break;
      DHPMAP_RETURN_IF_ERROR(check_stop_());
      ChangeRow row;
      const bool is_read = Changes().Read(select, row);
      ++totals.num_changes;
      totals.num_bytes += static_cast<std::int64_t>(row.blob.bytes.size());
      if (row.last_revision <= log.complete_after) continue;  // ignored: later commits delete it
      DHPMAP_RETURN_IF_ERROR(VerifyChange(row, is_read));
      const bool follows = is_first ? row.previous_revision <= previous : row.previous_revision == previous;
      if (!follows) {
        fault_(Kind::kCount, "changes", "after revision " + std::to_string(previous) + " are missing");
      }
      previous = row.last_revision;
      is_first = false;
    }
    if (previous < log.last_revision) {
      fault_(Kind::kCount, "changes", "after revision " + std::to_string(previous) + " are missing");
    }
    if (totals.num_changes != log.num_changes || totals.num_bytes != log.num_bytes) {
      fault_(Kind::kCount, "changes",
             "are " + std::to_string(totals.num_changes) + " of " + std::to_string(totals.num_bytes) + " bytes, not " +
                 std::to_string(log.num_changes) + " of " + std::to_string(log.num_bytes));
    }
    return Status::Ok();
  }

  Status VerifyChange(const ChangeRow& row, bool is_read) {
    const std::string place = "change of revision " + std::to_string(row.last_revision);
    if (!is_read || !Changes().IsIntact(row, row.seal)) {
      fault_(Kind::kRow, place, kWrongChecksum);
      return Status::Ok();
    }
    MapChange change;
    change.first_revision = row.first_revision;
    change.last_revision = row.last_revision;
    change.time_ns = row.time_ns;
    const Status decoded = DecodeChange(row.blob.bytes, change);
    if (decoded.code() == StatusCode::kDataLoss) fault_(Kind::kBlob, place, decoded.message());
    return decoded.code() == StatusCode::kDataLoss ? Status::Ok() : decoded;
  }

  Status VerifyEdits() {
    DHPMAP_ASSIGN_OR_RETURN(
        Statement select, database_.Prepare(Edits().Select("WHERE map_key = ? ORDER BY revision"), kVerifyHistoryTask));
    DHPMAP_ASSIGN_OR_RETURN(
        Statement find_target,
        database_.Prepare("SELECT (SELECT count(*) FROM edits WHERE map_key = ?1 AND revision = ?2), (SELECT count(*) "
                          "FROM edit_targets WHERE map_key = ?1 AND target = ?2 AND revision = ?3 AND kind = ?4)",
                          kVerifyHistoryTask));
    select.Bind(map_.key);
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
      if (!has_row) return Status::Ok();
      DHPMAP_RETURN_IF_ERROR(check_stop_());
      EditRow row;
      const bool is_read = Edits().Read(select, row);
      EditEntry entry{.revision = row.revision, .time_ns = row.time_ns, .source = {}, .summary = {}};
      DHPMAP_ASSIGN_OR_RETURN(const std::string problem, ProblemOf(row, is_read, entry));
      if (!problem.empty()) {
        fault_(Kind::kRow, EditName(row.revision), problem);
        bad_.edits.push_back(row.key);
        continue;
      }
      DHPMAP_RETURN_IF_ERROR(VerifyTargetsOf(row, entry, find_target));
    }
  }

  /// The reason why an edit cannot remain in the log; empty if it can.
  Result<std::string> ProblemOf(const EditRow& row, bool is_read, EditEntry& entry) const {
    if (!is_read || !Edits().IsIntact(row, row.seal)) return std::string(kWrongChecksum);
    // Another edit will get its revision.
    if (row.revision > map_.info.revision) return std::string("is of a later revision than the map");
    const Status decoded = DecodeEditSummary(row.summary.bytes, entry);
    if (decoded.code() == StatusCode::kDataLoss) return "says what cannot be read: it " + decoded.message();
    DHPMAP_RETURN_IF_ERROR(decoded);
    return std::string();
  }

  /// Checks that targets of an undo are recorded as undone.
  Status VerifyTargetsOf(const EditRow& row, const EditEntry& entry, Statement& find) {
    for (const std::int64_t target : entry.summary.targets) {
      find.Bind(map_.key).Bind(target).Bind(row.revision).Bind(static_cast<std::int64_t>(row.kind));
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, find.Step());
      if (has_row && find.Int(0) != 0 && find.Int(1) == 0) {
        fault_(Kind::kReference, EditName(target),
               "does not say that edit " + std::to_string(row.revision) + " has undone it or done it again");
      }
      find.Reset();
    }
    return Status::Ok();
  }

  Status VerifyHistories() {
    DHPMAP_ASSIGN_OR_RETURN(
        Statement select,
        database_.Prepare(EditHistories().Select(
                              "WHERE edit_key IN (SELECT edit_key FROM edits WHERE map_key = ?) ORDER BY edit_key"),
                          kVerifyHistoryTask));
    DHPMAP_ASSIGN_OR_RETURN(Statement find,
                            database_.Prepare("SELECT revision FROM edits WHERE edit_key = ?", kVerifyHistoryTask));
    select.Bind(map_.key);
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
      if (!has_row) return Status::Ok();
      EditHistoryRow row;
      const bool is_read = EditHistories().Read(select, row);
      DHPMAP_ASSIGN_OR_RETURN(const bool is_there, find.Bind(row.key).Step());
      const std::int64_t revision = is_there ? find.Int(0) : 0;
      find.Reset();
      const std::int64_t num_faults_before = num_undo_faults_;
      DHPMAP_RETURN_IF_ERROR(VerifyHistory(row, is_read, revision));
      if (num_undo_faults_ != num_faults_before) bad_.undos.push_back(row.key);
    }
  }

  void UndoFault(Kind kind, std::string place, std::string what) {
    ++num_undo_faults_;
    fault_(kind, std::move(place), std::move(what));
  }

  Status VerifyHistory(const EditHistoryRow& row, bool is_read, std::int64_t revision) {
    const std::string place = "what undoes " + EditName(revision);
    const bool is_its_own = row.revision == revision && row.map_key == map_.key;
    if (!is_read || !is_its_own || !EditHistories().IsIntact(row, row.seal)) {
      UndoFault(Kind::kRow, place, kWrongChecksum);
      return Status::Ok();
    }
    StateDelta delta;
    const Status decoded = DecodeEditRows(row.blob.bytes, revision, delta);
    if (decoded.code() == StatusCode::kDataLoss) {
      UndoFault(Kind::kBlob, place, decoded.message());
      return Status::Ok();
    }
    DHPMAP_RETURN_IF_ERROR(decoded);
    return VerifyEditTiles(row, delta);
  }

  Status VerifyEditTiles(const EditHistoryRow& history, const StateDelta& delta) {
    DHPMAP_ASSIGN_OR_RETURN(
        Statement select,
        database_.Prepare("SELECT submap_id, x, y, z, layer, before_key, after_key, b.blob_key IS NULL, a.blob_key IS "
                          "NULL, b.blob, a.blob FROM edit_tiles LEFT JOIN tile_blobs b ON b.blob_key = before_key LEFT "
                          "JOIN tile_blobs a ON a.blob_key = after_key WHERE edit_key = ? ORDER BY submap_id, x, y, z, "
                          "layer",
                          kVerifyHistoryTask));
    TileTotals totals;
    select.Bind(history.key);
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
      if (!has_row) break;
      DHPMAP_RETURN_IF_ERROR(check_stop_());
      Columns columns(select);
      EditTile tile;
      tile.submap_id = columns.Int();
      for (std::int32_t* axis : {&tile.index.x, &tile.index.y, &tile.index.z}) {
        *axis = static_cast<std::int32_t>(columns.Int());
      }
      tile.layer = columns.Int();
      const std::array<std::int64_t, 2> keys = {columns.Int(), columns.Int()};
      AddEditTile(totals, tile.submap_id, tile.index, tile.layer, keys[0], keys[1]);
      DHPMAP_RETURN_IF_ERROR(VerifyEditTile(history.revision, delta, tile, keys, columns));
    }
    if (totals.sum != history.tiles_sum) {
      UndoFault(Kind::kCount, "what undoes " + EditName(history.revision), "has other tiles than were stored");
    }
    return Status::Ok();
  }

  /// `columns`: positioned at whether the blobs of both sides are missing.
  Status VerifyEditTile(std::int64_t revision, const StateDelta& delta, const EditTile& tile,
                        const std::array<std::int64_t, 2>& keys, Columns& columns) {
    const std::string place = EditName(revision) + ": " + tile.Name();
    if (!tile.IsKnownLayer()) {
      return FailedPrecondition(place + " is of a layer unknown to this version").WithReason("NEWER_LAYER");
    }
    const bool is_named =
        tile.IsOfMap() || std::any_of(delta.submaps.begin(), delta.submaps.end(), [&tile](const SubmapDelta& submap) {
          return std::int64_t{submap.id.value} == tile.submap_id;
        });
    if (!is_named) UndoFault(Kind::kReference, place, "is of an object that the edit does not name");
    const std::array<bool, 2> are_missing = {columns.Int() != 0, columns.Int() != 0};
    for (const std::size_t side : {0u, 1u}) {
      const ByteView blob = columns.Blob();
      if (keys[side] == 0) continue;
      const Status status = are_missing[side] ? DataLoss("is missing") : tile.Decode(blob);
      if (status.code() == StatusCode::kFailedPrecondition) {
        return FailedPrecondition(place + " is of a codec unknown to this version").WithReason("NEWER_LAYER");
      }
      if (!status.ok()) UndoFault(Kind::kBlob, place, status.message());
    }
    return Status::Ok();
  }

  Status VerifyTargets() {
    DHPMAP_ASSIGN_OR_RETURN(
        Statement select,
        database_.Prepare("SELECT target, revision FROM edit_targets t WHERE map_key = ? AND NOT EXISTS (SELECT 1 FROM "
                          "edits e WHERE e.map_key = t.map_key AND e.revision = t.target) ORDER BY 1, 2",
                          kVerifyHistoryTask));
    select.Bind(map_.key);
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
      if (!has_row) return Status::Ok();
      DHPMAP_RETURN_IF_ERROR(check_stop_());
      fault_(Kind::kReference, EditName(select.Int(1)),
             "has undone edit " + std::to_string(select.Int(0)) + " or done it again, which the log does not have");
    }
  }

  Status VerifyTotals() {
    DHPMAP_ASSIGN_OR_RETURN(const EditTotals counted, CountEdits(database_, map_.key));
    DHPMAP_ASSIGN_OR_RETURN(Statement select, database_.Prepare("SELECT num_edits, edit_bytes, num_histories, "
                                                                "history_bytes FROM edit_totals WHERE map_key = ?",
                                                                kVerifyHistoryTask));
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Bind(map_.key).Step());
    EditTotals noted{};
    if (has_row) noted = {select.Int(0), select.Int(1), select.Int(2), select.Int(3)};
    if (counted != noted) {
      fault_(Kind::kCount, "edits",
             "are " + std::to_string(counted[0]) + ", of which " + std::to_string(counted[2]) +
                 " can be undone; their number or size is noted otherwise");
    }
    return Status::Ok();
  }

  Database& database_;
  const MapRow& map_;
  const std::function<Status()>& check_stop_;
  const FaultSink& fault_;
  BadHistory bad_;
  std::int64_t num_undo_faults_ = 0;
};

Status Delete(Database& database, const char* sql, const std::vector<std::int64_t>& keys) {
  DHPMAP_ASSIGN_OR_RETURN(Statement erase, database.Prepare(sql, kRepairHistoryTask));
  for (const std::int64_t key : keys) DHPMAP_RETURN_IF_ERROR(erase.Bind(key).Run());
  return Status::Ok();
}

/// Records for each remaining edit which edits it undid or redid.
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
  DHPMAP_ASSIGN_OR_RETURN(const EditTotals totals, CountEdits(database, map_key));
  DHPMAP_ASSIGN_OR_RETURN(Statement insert,
                          database.Prepare("INSERT OR REPLACE INTO edit_totals (map_key, num_edits, edit_bytes, "
                                           "num_histories, history_bytes) VALUES (?, ?, ?, ?, ?)",
                                           kRepairHistoryTask));
  insert.Bind(map_key);
  for (const std::int64_t total : totals) insert.Bind(total);
  return insert.Run();
}

}  // namespace

Result<BadHistory> VerifyHistory(Database& database, const MapRow& map, const std::function<Status()>& check_stop,
                                 const FaultSink& fault) {
  return HistoryVerifier(database, map, check_stop, fault).Run();
}

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

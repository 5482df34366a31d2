// SPDX-License-Identifier: BSD-3-Clause
#include "storage/check/verify_history.h"

#include <algorithm>
#include <utility>

#include "storage/codec/change_codec.h"
#include "storage/codec/edit_codec.h"
#include "storage/codec/free_codec.h"
#include "storage/history/logged_change.h"
#include "storage/tiles/object_layers.h"
#include "storage/tiles/tile_name.h"

namespace dhpmap {
namespace {

using Kind = MapFault::Kind;

constexpr char kWrongChecksum[] = "has a wrong checksum";

std::string EditName(std::int64_t revision) { return "edit " + std::to_string(revision); }

bool IsOfMap(const EditTileRow& row) { return row.submap_id == kMapsOwnTiles; }

std::string EditTileName(const EditTileRow& row) {
  if (IsOfMap(row)) return NameOfTile("vacated", row.index);
  return TileName(static_cast<std::uint32_t>(row.submap_id), row.layer, row.index);
}

bool IsKnownLayer(const EditTileRow& row) {
  return IsOfMap(row) ? row.layer == LayerNumber(BlobKind::kVacatedV1) : FindObjectLayer(row.layer) != nullptr;
}

Status DecodeSide(const EditTileRow& row, ByteView blob) {
  if (IsOfMap(row)) {
    FreeTile tile;
    return DecodeFreeTile(BlobKind::kVacatedV1, blob, row.index, tile);
  }
  BlockTile tile;
  return FindObjectLayer(row.layer)->decode(blob, row.index, tile);
}

class HistoryVerifier {
 public:
  HistoryVerifier(VerifiedHistory& rows, const MapRow& map, const std::function<Status()>& check_stop,
                  const FaultSink& fault)
      : rows_(rows), map_(map), check_stop_(check_stop), fault_(fault) {}

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
    const auto log = rows_.ReadChangeLog();
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
    ChangeTotals totals;
    std::int64_t previous = log.complete_after;
    bool is_first = true;
    const Status read = rows_.ForEachChange([&](const ChangeRow& row, bool is_read) -> Status {
      DHPMAP_RETURN_IF_ERROR(check_stop_());
      ++totals.num_changes;
      totals.num_bytes += static_cast<std::int64_t>(row.blob.bytes.size());
      if (row.last_revision <= log.complete_after) return Status::Ok();  // left out: to be deleted by commits to come
      DHPMAP_RETURN_IF_ERROR(VerifyChange(row, is_read));
      const bool follows = is_first ? row.previous_revision <= previous : row.previous_revision == previous;
      if (!follows) {
        fault_(Kind::kCount, "changes", "after revision " + std::to_string(previous) + " are missing");
      }
      previous = row.last_revision;
      is_first = false;
      return Status::Ok();
    });
    DHPMAP_RETURN_IF_ERROR(read);
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
    return rows_.ForEachEdit([this](const EditRow& row, bool is_read) -> Status {
      DHPMAP_RETURN_IF_ERROR(check_stop_());
      EditEntry entry{.revision = row.revision, .time_ns = row.time_ns, .source = {}, .summary = {}};
      DHPMAP_ASSIGN_OR_RETURN(const std::string problem, ProblemOf(row, is_read, entry));
      if (problem.empty()) return VerifyTargetsOf(row, entry);
      fault_(Kind::kRow, EditName(row.revision), problem);
      bad_.edits.push_back(row.key);
      return Status::Ok();
    });
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

  /// What an undo undid is said to be undone.
  Status VerifyTargetsOf(const EditRow& row, const EditEntry& entry) {
    for (const std::int64_t target : entry.summary.targets) {
      DHPMAP_ASSIGN_OR_RETURN(const bool is_lacking, rows_.LacksTarget(target, row));
      if (!is_lacking) continue;
      fault_(Kind::kReference, EditName(target),
             "does not say that edit " + std::to_string(row.revision) + " has undone it or done it again");
    }
    return Status::Ok();
  }

  Status VerifyHistories() {
    return rows_.ForEachHistory([this](const EditHistoryRow& row, bool is_read, std::int64_t revision) -> Status {
      const std::int64_t num_faults_before = num_undo_faults_;
      DHPMAP_RETURN_IF_ERROR(VerifyHistory(row, is_read, revision));
      if (num_undo_faults_ != num_faults_before) bad_.undos.push_back(row.key);
      return Status::Ok();
    });
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
    TileTotals totals;
    const Status read = rows_.ForEachEditTile(history, [&](const EditTileToVerify& tile) -> Status {
      DHPMAP_RETURN_IF_ERROR(check_stop_());
      const EditTileRow& row = tile.row;
      AddEditTile(totals, row.submap_id, row.index, row.layer, row.before_key, row.after_key);
      return VerifyEditTile(history.revision, delta, tile);
    });
    DHPMAP_RETURN_IF_ERROR(read);
    if (totals.sum != history.tiles_sum) {
      UndoFault(Kind::kCount, "what undoes " + EditName(history.revision), "has other tiles than were stored");
    }
    return Status::Ok();
  }

  Status VerifyEditTile(std::int64_t revision, const StateDelta& delta, const EditTileToVerify& tile) {
    const EditTileRow& row = tile.row;
    const std::string place = EditName(revision) + ": " + EditTileName(row);
    if (!IsKnownLayer(row)) {
      return FailedPrecondition(place + " is of a layer unknown to this version").WithReason("NEWER_LAYER");
    }
    const bool is_named =
        IsOfMap(row) || std::any_of(delta.submaps.begin(), delta.submaps.end(), [&row](const SubmapDelta& submap) {
          return std::int64_t{submap.id.value} == row.submap_id;
        });
    if (!is_named) UndoFault(Kind::kReference, place, "is of an object that the edit does not name");
    DHPMAP_RETURN_IF_ERROR(VerifySide(tile, row.before_key, row.before, tile.lacks_before, place));
    return VerifySide(tile, row.after_key, row.after, tile.lacks_after, place);
  }

  Status VerifySide(const EditTileToVerify& tile, std::int64_t key, ByteView blob, bool is_missing,
                    const std::string& place) {
    if (key == 0) return Status::Ok();
    const Status status = is_missing ? DataLoss("is missing") : DecodeSide(tile.row, blob);
    if (status.code() == StatusCode::kFailedPrecondition) {
      return FailedPrecondition(place + " is of a codec unknown to this version").WithReason("NEWER_LAYER");
    }
    if (!status.ok()) UndoFault(Kind::kBlob, place, status.message());
    return Status::Ok();
  }

  Status VerifyTargets() {
    return rows_.ForEachLostTarget([this](std::int64_t target, std::int64_t revision) -> Status {
      DHPMAP_RETURN_IF_ERROR(check_stop_());
      fault_(Kind::kReference, EditName(revision),
             "has undone edit " + std::to_string(target) + " or done it again, which the log does not have");
      return Status::Ok();
    });
  }

  Status VerifyTotals() {
    DHPMAP_ASSIGN_OR_RETURN(const EditTotals counted, rows_.CountEdits());
    DHPMAP_ASSIGN_OR_RETURN(const EditTotals noted, rows_.NotedEdits());
    if (counted != noted) {
      fault_(Kind::kCount, "edits",
             "are " + std::to_string(counted[0]) + ", of which " + std::to_string(counted[2]) +
                 " can be undone; their number or size is noted otherwise");
    }
    return Status::Ok();
  }

  VerifiedHistory& rows_;
  const MapRow& map_;
  const std::function<Status()>& check_stop_;
  const FaultSink& fault_;
  BadHistory bad_;
  std::int64_t num_undo_faults_ = 0;
};

}  // namespace

Result<BadHistory> VerifyHistory(VerifiedHistory& rows, const MapRow& map, const std::function<Status()>& check_stop,
                                 const FaultSink& fault) {
  return HistoryVerifier(rows, map, check_stop, fault).Run();
}

}  // namespace dhpmap

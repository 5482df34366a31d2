// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/check/repair.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "storage/postgres/check/repair_history.h"
#include "storage/postgres/check/repair_tiles.h"
#include "storage/postgres/check/resealed_submap.h"
#include "storage/postgres/check/rows_to_verify.h"
#include "storage/postgres/owners/lost_answer.h"
#include "storage/postgres/transaction_text.h"

namespace dhpmap::postgres {
namespace {

constexpr char kRepairTask[] = "repair the map";
const std::string kLockMap = "SELECT owner_epoch, commit_id FROM maps WHERE map_key = $1 FOR UPDATE";
const std::string kSilentOwners =
    "SELECT DISTINCT owner_id FROM tiles WHERE map_key = $1 AND owner_id >= 0 AND cells = 0";

Call CallOf(const std::string& text, std::int64_t map_key) {
  Call call{&text};
  call.values.Add(map_key);
  return call;
}

class Repairer {
 public:
  Repairer(Connection& connection, const OwnedMap& map, const NamedMap& verified, Verification& found)
      : connection_(connection), map_(map), verified_(verified), found_(found), rows_(connection, map.name) {}

  /// Runs within a transaction, which the caller commits.
  Result<MapHead> Run() {
    DHPMAP_RETURN_IF_ERROR(Lock());
    DHPMAP_RETURN_IF_ERROR(RunAll(CallsToDrop(map_.key, found_)));
    DHPMAP_ASSIGN_OR_RETURN(MapRow map, rows_.ReadMapRow());
    std::vector<SubmapRow> damaged;
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> submaps, rows_.ReadSubmapRows(damaged));
    DHPMAP_ASSIGN_OR_RETURN(const std::set<std::int64_t> wrong, WrongSubmaps());
    for (const SubmapRow& row : submaps) {
      if (!wrong.contains(row.key)) continue;
      DHPMAP_ASSIGN_OR_RETURN(const std::vector<Call> calls, ResealedSubmap(rows_, row, map.info.revision + 1));
      DHPMAP_RETURN_IF_ERROR(RunAll(calls));
    }
    DHPMAP_RETURN_IF_ERROR(RunAll(CallsForHistory(map_.key, found_.history, found_.IsStateWrong())));
    DHPMAP_RETURN_IF_ERROR(NoteTargets(connection_, map_.key));
    DHPMAP_RETURN_IF_ERROR(RunAll(CallsToCount(map_.key, map_.Now_ns())));
    return HeadAfter(std::move(map), submaps);
  }

 private:
  Status RunAll(const std::vector<Call>& calls) {
    return calls.empty() ? Status::Ok() : connection_.Run(calls, kRepairTask).status;
  }

  /// Locks the map's row until the end, and checks that nothing was committed since the map was verified.
  Status Lock() {
    DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection_.Query(CallOf(kLockMap, map_.key), kRepairTask));
    if (!answer.Next()) return NoSuchMap(map_.name);
    if (answer.Int() != map_.epoch) return NotOwner(map_.name);
    if (answer.Int() == verified_.head.commit_id) return Status::Ok();
    return FailedPrecondition("map '" + map_.name + "' was written to since it was verified")
        .WithReason("STALE_REVISION");
  }

  /// Submaps that were found damaged, and those with a tile that does not name its cells.
  Result<std::set<std::int64_t>> WrongSubmaps() {
    std::set<std::int64_t> wrong(found_.wrong_submaps.begin(), found_.wrong_submaps.end());
    DHPMAP_ASSIGN_OR_RETURN(Answer silent, connection_.Query(CallOf(kSilentOwners, map_.key), kRepairTask));
    while (silent.Next()) wrong.insert(silent.Int());
    return wrong;
  }

  Result<MapHead> HeadAfter(MapRow map, const std::vector<SubmapRow>& submaps) {
    map.tiles = TileTotals();
    DHPMAP_RETURN_IF_ERROR(rows_.ForEachTile(rows_.OwnerOfMapTiles(), [&map](const TileRow& row) {
      map.tiles.Add(row.index, row.layer, {.key = row.blob_key, .bytes = static_cast<std::int64_t>(row.blob.size())});
      return Status::Ok();
    }));
    map.num_submaps = static_cast<std::int64_t>(submaps.size());
    const bool is_leaving_there = std::any_of(submaps.begin(), submaps.end(), [&map](const SubmapRow& row) {
      return std::int64_t{row.info.id.value} == map.leaving_id;
    });
    if (!is_leaving_there) map.leaving_id = -1;
    ++map.info.revision;
    RaiseMarks(map);
    SealMapParts(map, rows_.map().parts);
    SealMapRow(map);
    MapHead head = rows_.map().head;
    head.row = std::move(map);
    ++head.commit_id;
    return head;
  }

  Connection& connection_;
  const OwnedMap& map_;
  const NamedMap& verified_;
  Verification& found_;
  RowsToVerify rows_;
};

}  // namespace

Status RepairMap(Connection& connection, const OwnedMap& map, const NamedMap& verified, Verification& found) {
  if (found.is_map_row_bad) return DamagedRows(map.name, "its row has a wrong checksum");
  DHPMAP_RETURN_IF_ERROR(connection.Execute(BeginText(), kRepairTask));
  Result<MapHead> after = Repairer(connection, map, verified, found).Run();
  if (!after.ok()) {
    if (!connection.IsBroken()) (void)connection.Execute("ROLLBACK", kRepairTask);
    return after.status();
  }
  const std::vector<Call> calls = {ReplaceHead(verified.head, *after), {&CommitText()}};
  const Answers done = connection.Run(calls, kRepairTask);
  if (!done.status.ok()) return done.status;
  if (done.has_warning) return Unavailable("the database does not say whether the repair is on its standbys");
  found.report.is_repaired = true;
  found.report.revision = after->row.info.revision;
  return Status::Ok();
}

}  // namespace dhpmap::postgres

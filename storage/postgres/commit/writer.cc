// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/commit/writer.h"

#include <optional>
#include <string>
#include <utility>

#include "mapping/map/same_state.h"
#include "storage/commit_rules.h"
#include "storage/postgres/owners/lost_answer.h"
#include "storage/postgres/transit/removal.h"

namespace dhpmap::postgres {
Writer::Writer(Pool& pool, MapOwnership& maps, const KeepingLimits& limits, std::chrono::milliseconds patience)
    : pool_(pool), maps_(maps), limits_(limits), sender_(pool, patience), codec_threads_(NumCodecThreads()) {}

Status Writer::Create(const MapSnapshot& snapshot) {
  const std::string& name = snapshot.info().name;
  DHPMAP_RETURN_IF_ERROR(ValidateMapName(name));
  const std::shared_ptr<OwnedMap> map = maps_.New(name);
  DHPMAP_ASSIGN_OR_RETURN(const CommitStatements statements,
                          StatementsOfNew(snapshot, *map, maps_.server(), limits_, codec_threads_));
  Answers done;
  {
    DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool_.Borrow());
    done = connection->Run(statements.calls, "create the map");
  }
  if (done.status.code() == StatusCode::kAlreadyExists) {
    return AlreadyExists("there is already a map '" + name + "'").WithReason("MAP_EXISTS");
  }
  if (done.outcome == Outcome::kRefused) return done.status;
  if (!IsAcknowledged(done)) {
    constexpr std::int64_t kFirstCommit = 1;
    const Result<bool> was_made = WasMade(pool_, *map, kFirstCommit);
    if (!was_made.ok()) return was_made.status().code() == StatusCode::kNotFound ? InDoubt(name) : was_made.status();
  }
  statements.written.TellTiles(map->number);
  maps_.Add(map);
  return Status::Ok();
}

Status Writer::Commit(const CommitRequest& request) {
  DHPMAP_RETURN_IF_ERROR(ValidateCommit(request.before.info(), request.after.info()));
  DHPMAP_ASSIGN_OR_RETURN(const std::shared_ptr<OwnedMap> map,
                          maps_.Own(request.before.info().name, MapOwnership::For::kWriting));
  const MutexLock lock(map->mutex);
  Status done = CommitOwned(*map, request);
  if (done.reason() == Reason("NOT_OWNER")) return maps_.LoseAndAsk(*map);
  if (done.code() == StatusCode::kNotFound) maps_.Lose(*map);
  return done;
}

Status Writer::CommitOwned(OwnedMap& map, const CommitRequest& request) {
  if (!map.doubt) return CommitFrom(map, request);
  DHPMAP_ASSIGN_OR_RETURN(const bool was_made, sender_.Settle(map));
  const Doubt doubt = *std::exchange(map.doubt, std::nullopt);
  if (!was_made || doubt.after == nullptr) return CommitFrom(map, request);
  // The store has the edit, which the caller has dropped: the map must be loaded again.
  if (doubt.is_edit) {
    Status stale = ValidateBase(request.before.info(), doubt.after->revision(), doubt.after->info().create_time_ns);
    return stale.ok() ? CommitFrom(map, request) : stale;
  }
  const bool is_from_before = request.before.revision() == doubt.revision_before;
  if (is_from_before && request.edit == nullptr && IsSameState(request.after.info(), doubt.after->info())) {
    return Status::Ok();
  }
  // The caller believes that the earlier state is stored: frames continue from the state that is stored.
  const bool is_later = is_from_before && request.edit == nullptr && request.after.revision() > doubt.after->revision();
  Status done = CommitFrom(map, is_later ? CommitRequest{*doubt.after, request.after} : request);
  if (map.doubt) map.doubt->revision_before = doubt.revision_before;
  else if (!done.ok()) map.doubt = doubt;  // settled, but the caller does not know yet
  return done;
}

Status Writer::CommitFrom(OwnedMap& map, const CommitRequest& request) {
  const std::vector<SubmapTileChange> changes = DiffTiles(request.before, request.after);
  const bool is_edit = request.edit != nullptr;
  const PlannedChanges planned{
      changes,
      DiffFreeSpace(request.before, *request.after.free_space()),
      DiffVacated(request.before, is_edit ? *request.after.noted_vacated() : *request.after.vacated()),
      is_edit,
      !is_edit && request.before.lacks_left(),
      map.number};
  FetchedState state;
  DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, FetchOver(map, planned, state));
  if (state.head.owner_epoch != map.epoch) return NotOwner(map.name);
  const MapInfo& stored = state.head.row.info;
  DHPMAP_RETURN_IF_ERROR(ValidateBase(request.before.info(), stored.revision, stored.create_time_ns));
  DHPMAP_ASSIGN_OR_RETURN(const CommitStatements statements,
                          StatementsOf(request, changes, map, limits_, codec_threads_, state));
  const auto doubt = [&]() -> Doubt {
    return {state.head.commit_id + 1, request.before.revision(), is_edit,
            std::make_shared<const StateMarks>(request.after, &request.before, is_edit)};
  };
  Status done = sender_.Send(map, std::move(connection), statements.calls, doubt);
  if (done.ok()) statements.written.TellTiles(map.number);
  return done;
}

/// An idle connection may have been lost. Fetching only reads, so it is repeated once on a new connection.
Result<Pool::Lease> Writer::FetchOver(const OwnedMap& map, const PlannedChanges& planned, FetchedState& state) {
  for (bool is_second = false;; is_second = true) {
    DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool_.Borrow(is_second));
    Status fetched = Fetch(*connection, map.name, map.key, planned, state);
    if (fetched.ok()) return Result<Pool::Lease>(std::move(connection));
    if (is_second || !connection->IsBroken()) return fetched;
  }
}

Status Writer::Delete(const std::string& name) {
  const Result<std::shared_ptr<OwnedMap>> owned = maps_.Own(name, MapOwnership::For::kLoading);
  const auto remove = [&](std::optional<std::int64_t> epoch) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool_.Borrow());
    return RemoveMap(*connection, name, epoch);
  };
  if (owned.status().code() == StatusCode::kDataLoss) return remove(std::nullopt);  // the damaged row names no owner
  if (!owned.ok()) return owned.status();
  OwnedMap& map = **owned;
  const MutexLock lock(map.mutex);
  Status removed = remove(map.epoch);
  if (removed.reason() == Reason("NOT_OWNER")) return maps_.LoseAndAsk(map);
  if (removed.ok() || removed.code() == StatusCode::kNotFound) maps_.Drop(map);
  return removed;
}

}  // namespace dhpmap::postgres

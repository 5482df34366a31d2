// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/transit/removal.h"

#include <vector>

#include "mapping/base/guarded.h"
#include "storage/postgres/owners/lost_answer.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/postgres/transaction_text.h"
#include "storage/postgres/transit/incoming_map.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {
namespace {

constexpr char kDeleteTask[] = "delete the map";
// Fails (see IsFenced) if the map exists and has another owner.
const std::string kCheckOwner =
    "WITH held AS (SELECT owner_epoch FROM maps WHERE name = $1 FOR UPDATE) SELECT 1 / (1 - count(*)) FROM held WHERE "
    "owner_epoch <> $2";
const std::string kRemoveName =
    "WITH gone AS (DELETE FROM map_names WHERE name = $1 RETURNING map_key) INSERT INTO removed_maps (map_key) SELECT "
    "map_key FROM gone";
const std::string kRemoveHead =
    "DELETE FROM maps WHERE name = $1 AND map_key IN (SELECT r.map_key FROM removed_maps r)";
const std::string kNextRemoved = "SELECT map_key FROM removed_maps ORDER BY map_key LIMIT 1";
const std::string kSweepBlobs =
    "DELETE FROM tile_blobs WHERE map_key = $1 AND blob_key IN (SELECT b.blob_key FROM tile_blobs b WHERE b.map_key = "
    "$1 "
    "ORDER BY b.blob_key LIMIT 512)";
const std::string kForgetRemoved = "DELETE FROM removed_maps WHERE map_key = $1";

/// Tables whose rows of a map are swept in one step, after its blobs.
const std::vector<std::string>& SweepTexts() {
  static const std::vector<std::string> texts = [] {
    std::vector<std::string> made;
    for (const char* table :
         {"tiles", "submaps", "blob_counts", "edit_tiles", "edit_histories", "edit_targets", "edit_totals", "edits",
          "changes", "change_logs", "lost_revisions", "map_config", "label_classes", "commit_places", "feed_sessions",
          "merged_ids", "object_pairs", "kept_clear"}) {
      made.push_back(std::string("DELETE FROM ") + table + " WHERE map_key = $1");
    }
    return made;
  }();
  return texts;
}

Status SweepRest(Connection& connection, std::int64_t map_key) {
  std::vector<Call> calls = {{&BeginText()}};
  for (const std::string& text : SweepTexts()) calls.emplace_back(Call{&text}).values.Add(map_key);
  calls.emplace_back(Call{&kForgetRemoved}).values.Add(map_key);
  calls.push_back({&CommitText()});
  return connection.Run(calls, kDeleteTask).status;
}

}  // namespace

Status RemoveMap(Connection& connection, const std::string& name, std::optional<std::int64_t> epoch) {
  std::vector<Call> calls = {{&BeginText()}};
  if (epoch) calls.emplace_back(Call{&kCheckOwner}).values.Add(name).Add(*epoch);
  const std::size_t removal = calls.size();
  calls.emplace_back(Call{&kRemoveName}).values.Add(name);
  calls.emplace_back(Call{&kRemoveHead}).values.Add(name);
  calls.push_back({&CommitText()});
  const Answers done = connection.Run(calls, kDeleteTask);
  if (IsFenced(done.sqlstate)) return NotOwner(name);
  if (!done.status.ok()) return done.status;
  return done.answers[removal].NumChanged() > 0 ? Status::Ok() : NoSuchMap(name);
}

Result<bool> SweepSome(Connection& connection) {
  DHPMAP_ASSIGN_OR_RETURN(Answer next, connection.Query({&kNextRemoved}, kDeleteTask));
  if (!next.Next()) {
    DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_given_up, GiveUpAbandoned(connection));
    return num_given_up > 0;
  }
  const std::int64_t map_key = next.Int();
  Call call{&kSweepBlobs};
  call.values.Add(map_key);
  DHPMAP_ASSIGN_OR_RETURN(const Answer swept, connection.Query(call, kDeleteTask));
  if (swept.NumChanged() > 0) return true;
  DHPMAP_RETURN_IF_ERROR(SweepRest(connection, map_key));
  return true;
}

Sweeper::Sweeper(Pool& pool) : pool_(pool), thread_([this] { Loop(); }) {}

Sweeper::~Sweeper() {
  {
    const MutexLock lock(mutex_);
    is_stopping_ = true;
    wake_.NotifyOne();
  }
  thread_.join();
}

void Sweeper::Notify() {
  const MutexLock lock(mutex_);
  has_work_ = true;
  wake_.NotifyOne();
}

void Sweeper::Wait() {
  const MutexLock lock(mutex_);
  is_idle_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return !has_work_ && !is_busy_; });
}

void Sweeper::Loop() {
  for (;;) {
    {
      const MutexLock lock(mutex_);
      is_busy_ = false;
      if (!has_work_) is_idle_.NotifyAll();
      wake_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return has_work_ || is_stopping_; });
      if (is_stopping_) return;
      has_work_ = false;
      is_busy_ = true;
    }
    SweepAll();
  }
}

/// Stops at an error: the next deletion, or the next process, tries again.
void Sweeper::SweepAll() {
  for (bool has_more = true; has_more;) {
    const auto swept = Guarded<Result<bool>>([this]() -> Result<bool> {
      DHPMAP_ASSIGN_OR_RETURN(Pool::Lease connection, pool_.Borrow());
      return SweepSome(*connection);
    });
    const MutexLock lock(mutex_);
    has_more = swept.ok() && *swept && !is_stopping_;
  }
}

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/commit/commit_sender.h"

#include <optional>
#include <thread>
#include <utility>

#include "storage/postgres/owners/lost_answer.h"
#include "storage/postgres/postgres_error.h"
#include "storage/postgres/rows/map_head.h"

namespace dhpmap::postgres {
namespace {

constexpr char kCommitTask[] = "commit";
constexpr int kMostSends = 6;

Status NotMade(const std::string& map) { return Unavailable("map '" + map + "': the database takes no commit now"); }

}  // namespace

bool IsAcknowledged(const Answers& answers) {
  return answers.outcome == Outcome::kDone && !answers.has_warning && answers.answers.back().Tag() == "COMMIT";
}

Status InDoubt(const std::string& map) {
  return Unavailable("map '" + map + "': the database does not say what became of the last commit");
}

Status CommitSender::Send(OwnedMap& map, Pool::Lease first, const std::vector<Call>& calls,
                          const std::function<Doubt()>& doubt) {
  std::optional<Pool::Lease> connection(std::move(first));
  for (int n = 0; n < kMostSends; ++n) {
    if (!connection) {
      DHPMAP_ASSIGN_OR_RETURN(Pool::Lease another, pool_.Borrow());
      connection.emplace(std::move(another));
    }
    const Answers done = (*connection)->Run(calls, kCommitTask);
    if (IsAcknowledged(done)) return Status::Ok();
    if (done.outcome == Outcome::kRefused) {
      if (IsFenced(done.sqlstate)) return NotOwner(map.name);
      if (IsWorthRepeating(done.sqlstate)) continue;
      return done.status;
    }
    connection.reset();  // before another connection asks for the outcome
    map.doubt = doubt();
    DHPMAP_ASSIGN_OR_RETURN(const bool was_made, SettleNow(map));
    map.doubt.reset();
    if (was_made) return Status::Ok();
  }
  return NotMade(map.name);
}

/// Tries until `patience_` has passed.
Result<bool> CommitSender::SettleNow(OwnedMap& map) {
  const auto end = std::chrono::steady_clock::now() + patience_;
  for (;;) {
    Result<bool> was_made = Settle(map);
    const Status& why = was_made.status();
    const bool is_silent = why.code() == StatusCode::kUnavailable && why.reason() != Reason("NOT_OWNER");
    if (!is_silent || std::chrono::steady_clock::now() >= end) return was_made;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

Result<bool> CommitSender::Settle(OwnedMap& map) { return WasMade(pool_, map, map.doubt->commit_id); }

}  // namespace dhpmap::postgres

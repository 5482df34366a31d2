// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "storage/postgres/owners/owned_map.h"
#include "storage/postgres/pool.h"

namespace dhpmap::postgres {

/// Sends the statements of commits, and finds out what became of those whose answer was lost. Thread-safe.
class CommitSender {
 public:
  /// `pool` outlives it. `patience`: for learning what became of a commit.
  CommitSender(Pool& pool, std::chrono::milliseconds patience) : pool_(pool), patience_(patience) {}

  /// Repeats what the database asks to repeat. If nobody knows whether the commit was made, `doubt` says what it was:
  /// it stays with the map unless that is settled here. UNAVAILABLE; NotOwner.
  Status Send(OwnedMap& map, Pool::Lease first, const std::vector<Call>& calls, const std::function<Doubt()>& doubt)
      DHPMAP_REQUIRES(map.mutex);
  /// Whether the commit in doubt was made.
  Result<bool> Settle(OwnedMap& map) DHPMAP_REQUIRES(map.mutex);

 private:
  Result<bool> SettleNow(OwnedMap& map) DHPMAP_REQUIRES(map.mutex);

  Pool& pool_;
  const std::chrono::milliseconds patience_;
};

/// Whether the commit was acknowledged by all who have to: after a warning it may be on this node alone.
bool IsAcknowledged(const Answers& answers);
/// UNAVAILABLE: the answer to the last commit was lost.
Status InDoubt(const std::string& map);

}  // namespace dhpmap::postgres

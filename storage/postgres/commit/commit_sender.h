// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "storage/postgres/owners/owned_map.h"
#include "storage/postgres/pool.h"

namespace dhpmap::postgres {

/// Sends commits, and settles those whose answer was lost. Thread-safe.
class CommitSender {
 public:
  /// `pool` outlives it. `patience`: how long it tries to settle a commit.
  CommitSender(Pool& pool, std::chrono::milliseconds patience) : pool_(pool), patience_(patience) {}

  /// Sends the statements again if the database asks for that. If the outcome is unknown and cannot be settled here,
  /// the commit that `doubt` returns stays with the map. UNAVAILABLE; NotOwner.
  Status Send(OwnedMap& map, Pool::Lease first, const std::vector<Call>& calls, const std::function<Doubt()>& doubt)
      DHPMAP_REQUIRES(map.mutex);
  /// Whether the commit with the unknown outcome was made.
  Result<bool> Settle(OwnedMap& map) DHPMAP_REQUIRES(map.mutex);

 private:
  Result<bool> SettleNow(OwnedMap& map) DHPMAP_REQUIRES(map.mutex);

  Pool& pool_;
  const std::chrono::milliseconds patience_;
};

/// Whether the primary and its standbys acknowledged the commit. After a warning it may be on the primary alone.
bool IsAcknowledged(const Answers& answers);
/// UNAVAILABLE: the answer to the last commit was lost.
Status InDoubt(const std::string& map);

}  // namespace dhpmap::postgres

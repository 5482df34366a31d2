// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "mapping/base/thread_pool.h"
#include "storage/postgres/commit/commit.h"
#include "storage/postgres/commit/commit_sender.h"
#include "storage/postgres/owners/map_ownership.h"
#include "storage/postgres/pool.h"

namespace dhpmap::postgres {

/// Writes the maps that this process owns. Thread-safe. Commits of one map run one after the other, those of several
/// maps in parallel.
class Writer {
 public:
  /// All outlive it. `patience`: how long it tries to settle a commit whose answer was lost.
  Writer(Pool& pool, MapOwnership& maps, const KeepingLimits& limits, std::chrono::milliseconds patience);

  // As those of MapStore.
  Status Create(const MapSnapshot& snapshot);
  Status Commit(const CommitRequest& request);
  Status Reserve(const std::string& name, const NumberMarks& marks);
  Status Delete(const std::string& name);

 private:
  Status CommitOwned(OwnedMap& map, const CommitRequest& request) DHPMAP_REQUIRES(map.mutex);
  Status ReserveOwned(OwnedMap& map, const NumberMarks& marks) DHPMAP_REQUIRES(map.mutex);
  Status CommitFrom(OwnedMap& map, const CommitRequest& request) DHPMAP_REQUIRES(map.mutex);
  Result<Pool::Lease> FetchOver(const OwnedMap& map, const PlannedChanges& planned, FetchedState& state);

  Pool& pool_;
  MapOwnership& maps_;
  const KeepingLimits& limits_;
  CommitSender sender_;
  ThreadPool codec_threads_;
};

}  // namespace dhpmap::postgres

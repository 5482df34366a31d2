// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "storage/postgres/commit/commit_request.h"
#include "storage/postgres/commit/fetched_state.h"
#include "storage/postgres/owners/owned_map.h"
#include "storage/snapshot_writer.h"

namespace dhpmap::postgres {

/// The statements of a commit, from BEGIN to COMMIT, to be sent as one pipeline.
struct CommitStatements {
  std::vector<Call> calls;
  WrittenTiles written;
};

/// The statements that bring a map from the fetched state to `request.after`. They fail if the map has changed since it
/// was fetched. FAILED_PRECONDITION as MapStore::Commit.
Result<CommitStatements> StatementsOf(const CommitRequest& request, const std::vector<SubmapTileChange>& changes,
                                      const OwnedMap& map, const KeepingLimits& limits, ThreadPool& pool,
                                      FetchedState& state);

/// The statements that add a map with that key, owned by `owner`.
Result<CommitStatements> StatementsOfNew(const MapSnapshot& snapshot, const OwnedMap& map, std::int64_t owner,
                                         const KeepingLimits& limits, ThreadPool& pool);

}  // namespace dhpmap::postgres

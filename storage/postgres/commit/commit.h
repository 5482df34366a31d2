// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/changes/state_marks.h"
#include "storage/postgres/commit/fetched_state.h"
#include "storage/postgres/owners/owned_map.h"
#include "storage/snapshot_writer.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// What bounds the logs of maps, and what is deleted when.
struct KeepingLimits {
  ChangeHistoryLimits changes = {};
  EditLogLimits edits = {};
  double dead_grace_s = 600;  ///< blobs that nobody refers to stay so long, for who still reads an old state
};

/// A commit: its two states, and the edit that made the second (null: none).
struct CommitRequest {
  const StateMarks& before;
  const MapSnapshot& after;
  const EditRecord* edit = nullptr;
};

/// A commit as statements, from BEGIN to COMMIT, to be sent in one go.
struct CommitStatements {
  std::vector<Call> calls;
  WrittenTiles written;
};

/// The statements that bring a map from the fetched state to `request.after`. They run only if the map is still as it
/// was fetched. FAILED_PRECONDITION as MapStore::Commit.
Result<CommitStatements> StatementsOf(const CommitRequest& request, const std::vector<SubmapTileChange>& changes,
                                      const OwnedMap& map, const KeepingLimits& limits, ThreadPool& pool,
                                      FetchedState& state);

/// The statements that add a map with that key, owned by `owner`.
Result<CommitStatements> StatementsOfNew(const MapSnapshot& snapshot, const OwnedMap& map, std::int64_t owner,
                                         const KeepingLimits& limits, ThreadPool& pool);

const std::string& BeginText();
const std::string& CommitText();

}  // namespace dhpmap::postgres

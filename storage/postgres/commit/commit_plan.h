// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "storage/postgres/commit/commit_request.h"
#include "storage/postgres/commit/fetched_state.h"
#include "storage/postgres/history/edit_tile_writes.h"
#include "storage/postgres/owners/owned_map.h"
#include "storage/rows/map_parts.h"
#include "storage/snapshot_writer.h"

namespace dhpmap::postgres {

/// Plans the statements of one commit from the fetched state. Used once; thread-compatible.
class CommitPlan {
 public:
  /// All outlive it.
  CommitPlan(const CommitRequest& request, const std::vector<SubmapTileChange>& changes, const OwnedMap& map,
             const KeepingLimits& limits, ThreadPool& pool, FetchedState& state)
      : request_(request),
        changes_(changes),
        map_(map),
        limits_(limits),
        pool_(pool),
        state_(state),
        now_ns_(map.Now_ns()),
        own_tiles_(request.after.revision(), state.tiles) {}

  /// Adds everything but the head's row, BEGIN and COMMIT, and updates the head.
  Result<WrittenTiles> Make(const MapParts& parts_before, MapHead& head, std::vector<Call>& calls);

 private:
  void WriteLogs(bool is_kept, std::vector<Call>& calls);

  const CommitRequest& request_;
  const std::vector<SubmapTileChange>& changes_;
  const OwnedMap& map_;
  const KeepingLimits& limits_;
  ThreadPool& pool_;
  FetchedState& state_;
  const std::int64_t now_ns_;
  EditTileWrites own_tiles_;
};

}  // namespace dhpmap::postgres

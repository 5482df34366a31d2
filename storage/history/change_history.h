// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "mapping/changes/map_change.h"
#include "mapping/map/map.h"
#include "storage/rows/change_rows.h"
#include "storage/rows/map_rows.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// What a map's commits changed, as far back as the limits say; see MapStore::ListChanges.

/// How much is kept of one map's changes.
struct ChangeTotals {
  std::int64_t num_changes = 0;
  std::int64_t num_bytes = 0;
};

// Ages are by SeenClock.

/// Whether the oldest change, of the time `oldest_ns`, is beyond the limits at the time `now_ns`.
bool IsBeyond(const ChangeHistoryLimits& limits, const ChangeTotals& totals, std::int64_t oldest_ns,
              std::int64_t now_ns);

/// What is answered for changes that are not kept any more, or never were.
Status ChangesNotKept(std::int64_t complete_after);

/// Writes what a commit changed, within its transaction, and deletes some of what is beyond the limits then: of a long
/// past more than one commit's part, so that none takes long. A log that is damaged, or of another history, begins
/// anew. `info`: of the state after.
Status RecordChange(sqlite::Database& database, std::int64_t map_key, const MapInfo& info, const MapChange& change,
                    std::int64_t now_ns, const ChangeHistoryLimits& limits);

/// Of a map that became another state than its commits made it: whoever follows it has to list it again.
Status ForgetChanges(sqlite::Database& database, std::int64_t map_key);

/// See MapStore::ListChanges. `map` is its row as it is now.
Result<ChangeList> ReadChanges(sqlite::Database& database, const MapRow& map, std::int64_t after_revision,
                               std::size_t max_bytes);

}  // namespace dhpmap

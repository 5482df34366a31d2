// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "mapping/changes/map_change.h"
#include "mapping/map/map.h"
#include "storage/history/logged_change.h"
#include "storage/rows/change_rows.h"
#include "storage/rows/map_rows.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// The changes of a map's commits, as far back as the limits allow; see MapStore::ListChanges.

/// Writes the change of a commit, within its transaction, and trims the history: of a large excess only a few more rows
/// than a commit adds, so that no commit takes long. A damaged log, or one of another history, starts anew. `info`: of
/// the later state.
Status RecordChange(sqlite::Database& database, std::int64_t map_key, const MapInfo& info, const MapChange& change,
                    std::int64_t now_ns, const ChangeHistoryLimits& limits);

/// For a map whose state was changed other than by commits (repair): watchers must list it again.
Status ForgetChanges(sqlite::Database& database, std::int64_t map_key);

/// See MapStore::ListChanges. `map` is its present row.
Result<ChangeList> ReadChanges(sqlite::Database& database, const MapRow& map, std::int64_t after_revision,
                               std::size_t max_bytes);

}  // namespace dhpmap

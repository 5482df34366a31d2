// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "storage/rows/map_rows.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// What a map's commits changed, the log of its edits, and what undoes them: the map is whole without these.

/// Hears of each fault, as MapFault has it.
using FaultSink = std::function<void(MapFault::Kind kind, std::string place, std::string what)>;

/// Of a map's histories, what cannot be kept.
struct BadHistory {
  std::vector<std::int64_t> edits;  ///< keys of those whose rows cannot be read; what undoes them goes with them
  std::vector<std::int64_t> undos;  ///< keys of edits that cannot be undone
};

/// Looks through all of them within the caller's transaction, row by row. `check_stop` is called for each row, and ends
/// it with its error. FAILED_PRECONDITION for what a later version wrote.
Result<BadHistory> VerifyHistory(sqlite::Database& database, const MapRow& map,
                                 const std::function<Status()>& check_stop, const FaultSink& fault);

/// Within the caller's transaction: drops what cannot be kept of the log and counts the rest anew. Where the state has
/// become another than the edits made (`is_state_changed`), nothing of what undoes them is kept: the log tells still
/// what was done, and requests that are repeated find their answers.
Status RepairHistory(sqlite::Database& database, std::int64_t map_key, const BadHistory& bad, bool is_state_changed);

}  // namespace dhpmap

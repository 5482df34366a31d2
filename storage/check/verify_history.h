// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "storage/check/verified_history.h"
#include "storage/rows/map_row.h"
#include "storage/store.h"

namespace dhpmap {

// Changes of a map's commits, the log of its edits, and undo data: the map is complete without them.

/// Called for each fault, as in MapFault.
using FaultSink = std::function<void(MapFault::Kind kind, std::string place, std::string what)>;

/// Parts of a map's histories that cannot be kept.
struct BadHistory {
  std::vector<std::int64_t> edits;  ///< keys of edits with unreadable rows; their undo data go as well
  std::vector<std::int64_t> undos;  ///< keys of edits that cannot be undone
};

/// Verifies all of them, row by row. An error of `check_stop`, called for each row,
/// ends it. FAILED_PRECONDITION for data of a later version.
Result<BadHistory> VerifyHistory(VerifiedHistory& rows, const MapRow& map, const std::function<Status()>& check_stop,
                                 const FaultSink& fault);

}  // namespace dhpmap

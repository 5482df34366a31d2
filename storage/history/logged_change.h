// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "mapping/changes/map_change.h"
#include "storage/rows/change_rows.h"
#include "storage/store.h"

namespace dhpmap {

// Rows of the change log <-> what they say, and what the log's limits mean, for every store.

/// Amount of kept changes of one map.
struct ChangeTotals {
  std::int64_t num_changes = 0;
  std::int64_t num_bytes = 0;
};

// Ages are by SeenClock.

/// Whether the oldest change, made at `oldest_ns`, exceeds the limits at `now_ns`.
bool IsBeyond(const ChangeHistoryLimits& limits, const ChangeTotals& totals, std::int64_t oldest_ns,
              std::int64_t now_ns);

/// The error for changes that are not kept or never existed.
Status ChangesNotKept(std::int64_t complete_after);

/// The error for changes that are not what was written.
Status DamagedChanges(const std::string& map, std::int64_t after_revision);

/// The row of a change that goes on from `log`, sealed. `blob`: the change, encoded.
ChangeRow ChangeRowOf(const MapChange& change, Bytes blob, std::int64_t now_ns, const ChangeLogRow& log);

/// Where a reader is in the log.
struct ChangePlace {
  std::int64_t previous = 0;  ///< last revision of the change before, or where reading began
  bool is_first = false;
};
/// The change of a row. DATA_LOSS, reason DAMAGED_CHANGES, unless it was read whole, is intact and goes on from there.
Result<std::shared_ptr<const MapChange>> ChangeOf(bool is_read, const ChangeRow& row, const std::string& map,
                                                  const ChangePlace& place);

}  // namespace dhpmap

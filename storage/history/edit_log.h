// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/rows/map_rows.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// The log of a map's edits, as far back as the limits say; see MapStore::ListEdits.

// Ages are by SeenClock.

/// Whether the oldest edit, of the time `oldest_ns`, is beyond the limits at the time `now_ns`.
bool IsBeyond(const EditLogLimits& limits, std::int64_t num_edits, std::int64_t num_bytes, std::int64_t oldest_ns,
              std::int64_t now_ns);
/// How much of the log's limit an edit takes.
std::int64_t LogBytesOf(const EditRecord& edit, std::size_t summary_bytes);

/// Writes an edit, within the transaction of its state, and deletes some of what is beyond the limits then. Returns its
/// key.
Result<std::int64_t> RecordEdit(sqlite::Database& database, std::int64_t map_key, const EditRecord& edit,
                                std::int64_t now_ns, const EditLogLimits& limits);

/// See MapStore::ListEdits and FindAnswer. `map` is its row as it is now.
Result<std::vector<LoggedEdit>> ReadEdits(sqlite::Database& database, const MapRow& map, const EditQuery& query);
Result<std::optional<StoredAnswer>> ReadAnswer(sqlite::Database& database, const MapRow& map,
                                               const std::string& request_id);

}  // namespace dhpmap

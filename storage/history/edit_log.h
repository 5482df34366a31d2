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

// The log of a map's edits, as far back as the limits allow; see MapStore::ListEdits.

// Ages are by SeenClock.

/// Whether the oldest edit, made at `oldest_ns`, exceeds the limits at `now_ns`.
bool IsBeyond(const EditLogLimits& limits, std::int64_t num_edits, std::int64_t num_bytes, std::int64_t oldest_ns,
              std::int64_t now_ns);
/// Bytes of an edit that count against the log's limit.
std::int64_t LogBytesOf(const EditRecord& edit, std::size_t summary_bytes);

/// Writes an edit, within the transaction of its state, and trims the log. Returns its key.
Result<std::int64_t> RecordEdit(sqlite::Database& database, std::int64_t map_key, const EditRecord& edit,
                                std::int64_t now_ns, const EditLogLimits& limits);

/// See MapStore::ListEdits and FindAnswer. `map` is its present row.
Result<std::vector<LoggedEdit>> ReadEdits(sqlite::Database& database, const MapRow& map, const EditQuery& query);
Result<std::optional<StoredAnswer>> ReadAnswer(sqlite::Database& database, const MapRow& map,
                                               const std::string& request_id);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/history/logged_edit.h"
#include "storage/rows/map_rows.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// The log of a map's edits, as far back as the limits allow; see MapStore::ListEdits.

/// Writes an edit, within the transaction of its state, and trims the log. Returns its key.
Result<std::int64_t> RecordEdit(sqlite::Database& database, std::int64_t map_key, const EditRecord& edit,
                                std::int64_t now_ns, const EditLogLimits& limits);

/// See MapStore::ListEdits and FindAnswer. `map` is its present row.
Result<std::vector<LoggedEdit>> ReadEdits(sqlite::Database& database, const MapRow& map, const EditQuery& query);
Result<std::optional<StoredAnswer>> ReadAnswer(sqlite::Database& database, const MapRow& map,
                                               const std::string& request_id);

}  // namespace dhpmap

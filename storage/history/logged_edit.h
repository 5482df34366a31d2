// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "storage/rows/edit_rows.h"
#include "storage/store.h"

namespace dhpmap {

// Rows of the edit log <-> what they say, and what the log's limits mean, for every store.

// Ages are by SeenClock.

/// Whether the oldest edit, made at `oldest_ns`, exceeds the limits at `now_ns`.
bool IsBeyond(const EditLogLimits& limits, std::int64_t num_edits, std::int64_t num_bytes, std::int64_t oldest_ns,
              std::int64_t now_ns);
/// Bytes of an edit that count against the log's limit.
std::int64_t LogBytesOf(const EditRecord& edit, std::size_t summary_bytes);

/// The row of an edit, sealed.
EditRow EditRowOf(std::int64_t map_key, const EditRecord& edit, std::int64_t now_ns);
/// DATA_LOSS, reason DAMAGED_EDITS, unless the row was read whole and matches its checksum.
Status CheckEdit(bool is_read, const EditRow& row, const std::string& map);
/// All but is_undone and is_kept. DAMAGED_EDITS.
Result<LoggedEdit> LoggedEditOf(const EditRow& row, const std::string& map);
StoredAnswer AnswerOf(const EditRow& row);

}  // namespace dhpmap

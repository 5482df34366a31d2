// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "storage/check/verify_history.h"
#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// The statements that drop damaged parts of a map's edit log, rows that belong to no edit, and all changes, so clients
/// that follow the map list it again. If the repair itself changed the state (`is_state_changed`), they also drop all
/// undo data; the log and the answers to repeated requests stay. They count the totals again.
std::vector<Call> CallsForHistory(std::int64_t map_key, const BadHistory& bad, bool is_state_changed);

/// Run afterwards in the same transaction: marks each remaining edit as undone or redone, as the log says.
Status NoteTargets(Connection& connection, std::int64_t map_key);

}  // namespace dhpmap::postgres

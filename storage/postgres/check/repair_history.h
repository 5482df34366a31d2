// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "storage/check/verify_history.h"
#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

/// The statements that drop bad parts of a map's edit log, what belongs to no edit, and all changes: who follows the
/// map lists it again. If the state was changed other than by edits (`is_state_changed`), all undo data are dropped;
/// log and answers to repeated requests stay. The totals are counted anew.
std::vector<Call> CallsForHistory(std::int64_t map_key, const BadHistory& bad, bool is_state_changed);

/// Afterwards, in the same transaction: says of each edit that is left what the log says that was undone or done again.
Status NoteTargets(Connection& connection, std::int64_t map_key);

}  // namespace dhpmap::postgres

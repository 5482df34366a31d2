// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <string>

#include "storage/check/verify.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Verifies a map within the caller's transaction; of the database's references those of all maps. Errors as Verify.
Result<Verification> VerifyRows(sqlite::Database& database, const std::string& name, VerifyScope scope,
                                const std::stop_token& stop);

/// Within the caller's transaction: drops unreadable data of a map that was not written since, and updates rows to the
/// rest, as a new revision; watchers list it again. Readable edits stay in the log, and their undo data unless the
/// state is wrong. Data that belong to no map are deleted. DATA_LOSS if the map's own row is damaged.
Status RepairRows(sqlite::Database& database, const std::string& name, Verification& found);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "storage/check/verify.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/owners/owned_map.h"
#include "storage/postgres/reading/named_map.h"

namespace dhpmap::postgres {

/// Drops unreadable data of a map that is ours and was not written since it was verified, and updates rows to the rest,
/// as a new revision; as RepairRows does in SQLite. All of it, or nothing. `verified`: as it was read then. NotOwner if
/// somebody else has taken the map, FAILED_PRECONDITION, reason STALE_REVISION, if it was written to; UNAVAILABLE if
/// the database does not say whether it was done: verify it again.
Status RepairMap(Connection& connection, const OwnedMap& map, const NamedMap& verified, Verification& found);

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "storage/check/verify.h"
#include "storage/postgres/connection.h"
#include "storage/postgres/owners/owned_map.h"
#include "storage/postgres/reading/named_map.h"

namespace dhpmap::postgres {

/// Drops the unreadable data of a map that this process owns, and updates the other rows to match, as a new revision.
/// Does all of it or nothing; RepairRows is the same for SQLite. `verified`: the state that was verified. NotOwner if
/// another server has taken the map; FAILED_PRECONDITION, reason STALE_REVISION, if the map was written since;
/// UNAVAILABLE if the outcome is unknown: verify the map again.
Status RepairMap(Connection& connection, const OwnedMap& map, const NamedMap& verified, Verification& found);

}  // namespace dhpmap::postgres

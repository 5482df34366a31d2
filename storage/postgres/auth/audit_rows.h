// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "storage/auth_tables.h"
#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

// As AuthTables promises.
Status AppendAuditRows(Connection& connection, std::span<const AuditRow> rows);
Result<std::vector<AuditRow>> ReadAuditRows(Connection& connection, const AuditQuery& query);
/// Deletes rows before `oldest_s`, and all but the newest `most_rows`. Keeps or deletes rows of one second together.
Status DeleteOldAuditRows(Connection& connection, std::int64_t oldest_s, std::int64_t most_rows);

}  // namespace dhpmap::postgres

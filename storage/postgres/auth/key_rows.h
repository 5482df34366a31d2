// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "storage/auth_tables.h"
#include "storage/postgres/connection.h"

namespace dhpmap::postgres {

// As AuthTables promises.
Result<std::int64_t> ReadKeysVersion(Connection& connection);
Result<KeyRows> ReadKeyRows(Connection& connection);
Status WriteKeyRows(Connection& connection, std::int64_t seen_version, std::span<const KeyRow> changed);

}  // namespace dhpmap::postgres

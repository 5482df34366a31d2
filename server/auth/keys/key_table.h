// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mapping/base/result.h"
#include "server/auth/keys/key_record.h"
#include "storage/auth_tables.h"

namespace dhpmap::auth {

/// The keys that all servers on one database share. Each row holds a line as in a key file.
struct KeyTableContent {
  std::vector<KeyRecord> records;
  std::int64_t version = 0;  ///< see AuthTables::KeysVersion
};

/// Errors as of AuthTables. FAILED_PRECONDITION, reason BAD_KEY_FILE, for a malformed row: then no key is taken.
Result<KeyTableContent> ReadKeyTable(AuthTables& tables);

/// Adds and changes keys as `change` does to the records; it runs again if somebody else changes the table meanwhile.
/// Returns errors of `change`, after which the table is unchanged, or errors as in ReadKeyTable. UNAVAILABLE also if
/// the database was lost on the way: then the change may be stored.
Status ChangeKeyTable(AuthTables& tables, const std::function<Status(std::vector<KeyRecord>&)>& change);

}  // namespace dhpmap::auth

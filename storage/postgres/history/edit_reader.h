// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "storage/postgres/connection.h"
#include "storage/store.h"

namespace dhpmap::postgres {

// Reads the log of a map's edits. Errors as those of MapStore.

Result<std::vector<LoggedEdit>> ReadEditLog(Connection& connection, const std::string& name, const EditQuery& query);
Result<std::optional<StoredAnswer>> ReadStoredAnswer(Connection& connection, const std::string& name,
                                                     const std::string& request_id);

}  // namespace dhpmap::postgres

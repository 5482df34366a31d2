// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/postgres/connection.h"
#include "storage/store.h"

namespace dhpmap::postgres {

// What is kept of a map's changes and edits. Errors as those of MapStore.

Result<ChangeList> ReadChangeList(Connection& connection, const std::string& name, std::int64_t after_revision,
                                  std::size_t max_bytes);
Result<std::vector<LoggedEdit>> ReadEditLog(Connection& connection, const std::string& name, const EditQuery& query);
Result<std::optional<StoredAnswer>> ReadStoredAnswer(Connection& connection, const std::string& name,
                                                     const std::string& request_id);
/// `store`: for the keys of tiles.
Result<StateDelta> ReadEditDelta(Connection& connection, const std::string& name, std::int64_t revision,
                                 std::uint16_t store);

}  // namespace dhpmap::postgres

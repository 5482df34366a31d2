// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "storage/postgres/connection.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// As MapStore::LoadEdit. `store`: for the keys of tiles.
Result<StateDelta> ReadEditDelta(Connection& connection, const std::string& name, std::int64_t revision,
                                 std::uint16_t store);

}  // namespace dhpmap::postgres

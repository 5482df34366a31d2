// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "storage/postgres/connection.h"
#include "storage/postgres/rows/map_head.h"

namespace dhpmap::postgres {

/// The row of a map alone. NOT_FOUND; DATA_LOSS.
Result<MapHead> ReadHeadOf(Connection& connection, const std::string& name);

}  // namespace dhpmap::postgres

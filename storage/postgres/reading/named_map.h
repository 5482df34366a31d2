// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "storage/postgres/connection.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {

/// A map's row, filled with what stands in other tables.
struct NamedMap {
  MapHead head;
  MapParts parts;  ///< as they are stored
};

/// Within the caller's transaction, in two round trips. NOT_FOUND; DATA_LOSS if they are not what was written together;
/// FAILED_PRECONDITION as ConfigOf.
Result<NamedMap> ReadNamedMap(Connection& connection, const std::string& name);

}  // namespace dhpmap::postgres

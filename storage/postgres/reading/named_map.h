// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "storage/postgres/connection.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/rows/map_parts.h"

namespace dhpmap::postgres {

/// A map's row, filled from the other tables.
struct NamedMap {
  MapHead head;
  MapParts parts;  ///< as they are stored
};

/// Reads it within the caller's transaction, in two round trips. NOT_FOUND; DATA_LOSS if the rows do not match each
/// other; FAILED_PRECONDITION as ConfigOf.
Result<NamedMap> ReadNamedMap(Connection& connection, const std::string& name);

}  // namespace dhpmap::postgres

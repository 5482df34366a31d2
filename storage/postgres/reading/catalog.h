// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "storage/postgres/connection.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// See MapStore::ListMaps: two round trips.
Result<std::vector<StoredMap>> ListCatalog(Connection& connection, const std::string& after, std::size_t max);
/// See MapStore::ListMapNames.
Result<std::vector<std::string>> ListNames(Connection& connection, const std::string& after, std::size_t max);
/// NOT_FOUND; DATA_LOSS if it is damaged.
Result<StoredMap> FindInCatalog(Connection& connection, const std::string& name);

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "storage/postgres/connection.h"
#include "storage/postgres/map_head.h"
#include "storage/postgres/owned_map.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// All maps by name, damaged ones included: two round trips for each page.
Result<std::vector<StoredMap>> ListCatalog(Connection& connection);
/// NOT_FOUND; DATA_LOSS if it is damaged.
Result<StoredMap> FindInCatalog(Connection& connection, const std::string& name);

/// Makes `server` the owner of a map, whoever was it, and leaves the numbers that the last owner has reserved: see
/// MapStore::Reserve. NOT_FOUND; NotOwner if others do the same at this moment.
Result<std::shared_ptr<OwnedMap>> TakeMap(Connection& connection, const std::string& name, std::int64_t server,
                                          const PassingTime& passing);

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mapping/base/result.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

/// See MapStore::ListMaps: a fixed number of statements, whatever the page holds. Within the caller's transaction.
Result<std::vector<StoredMap>> ReadMapPage(sqlite::Database& database, const std::string& after, std::size_t max);

/// See MapStore::ListMapNames.
Result<std::vector<std::string>> ReadMapNamesAfter(sqlite::Database& database, const std::string& after,
                                                   std::size_t max);

}  // namespace dhpmap

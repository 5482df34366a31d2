// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "storage/postgres/connection.h"
#include "storage/postgres/rows/map_head.h"
#include "storage/rows/map_parts.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// Whether to sum the tiles of a map over its submaps.
enum class TileSums { kNone, kAll };

/// The rows of a page of maps.
struct CatalogPage {
  std::vector<std::pair<MapHead, bool>> heads;  ///< second: whether the row could be read
  std::map<std::int64_t, MapParts> parts;
  std::map<std::int64_t, StoredMap> rest;  ///< fields that come from other tables
};

/// Reads the maps that the SELECT of heads returns, in one transaction of two round trips: one state of all.
Result<CatalogPage> ReadCatalogPage(Connection& connection, Call heads, TileSums sums);

}  // namespace dhpmap::postgres

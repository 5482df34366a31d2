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

/// Whether the tiles of a map are summed up over its submaps.
enum class TileSums { kNone, kAll };

/// What is read of the maps of a page.
struct CatalogPage {
  std::vector<std::pair<MapHead, bool>> heads;  ///< and whether the row could be read
  std::map<std::int64_t, MapParts> parts;
  std::map<std::int64_t, StoredMap> rest;  ///< what stands in no row of theirs
};

/// The maps of the SELECT of heads. In one transaction of two round trips, so that no commit comes between.
Result<CatalogPage> ReadCatalogPage(Connection& connection, Call heads, TileSums sums);

}  // namespace dhpmap::postgres

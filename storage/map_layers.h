// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "mapping/map/free_space.h"
#include "mapping/map/map.h"
#include "mapping/map/state_marks.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// The layers of a map that belong to none of its objects: free space, and what objects have left.

struct MapLayers {
  std::shared_ptr<const FreeSpace> free_space, vacated;
};

/// Writes the tiles that differ, within the caller's transaction. FAILED_PRECONDITION if the stored ones, of which
/// there are `num_stored`, are not those of `before`.
Status WriteMapLayers(sqlite::Database& database, std::int64_t map_key, std::int64_t num_stored,
                      const StateMarks& before, const MapSnapshot& after);

/// Reads the tiles of a map, whose row says that it has `num_tiles`. DATA_LOSS naming the tile if one is damaged or
/// missing, FAILED_PRECONDITION for those of a later version's layer.
Result<MapLayers> ReadMapLayers(sqlite::Database& database, std::int64_t map_key, std::int64_t num_tiles);

}  // namespace dhpmap

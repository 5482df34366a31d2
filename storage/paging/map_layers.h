// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "mapping/changes/state_marks.h"
#include "mapping/free/free_space.h"
#include "mapping/map/map.h"
#include "storage/history/edit_history.h"
#include "storage/rows/map_rows.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// The layers of a map that belong to none of its objects: free space, and what objects have left.

struct MapLayers {
  std::shared_ptr<const FreeSpace> free_space, vacated;
};

/// What of them is written: all, or all but what MapSnapshot::leaving() has left.
struct MapLayersToWrite {
  const FreeSpace& free_space;
  const FreeSpace& vacated;
};

/// Writes the tiles that differ, within the caller's transaction. Returns the totals of all that are there then.
/// `recorder` (may be null) is told which blobs of the vacated space they were and are.
/// FAILED_PRECONDITION if the stored ones, which `head` tells of, are not those of `before`.
Result<TileTotals> WriteMapLayers(sqlite::Database& database, const MapRow& head, const StateMarks& before,
                                  const MapLayersToWrite& after, EditTileRecorder* recorder = nullptr);

/// Reads the tiles of a map and compares them with what its row says. DATA_LOSS naming the tile if one is damaged or
/// missing, FAILED_PRECONDITION for those of a later version's layer.
Result<MapLayers> ReadMapLayers(sqlite::Database& database, const MapRow& map);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "mapping/changes/state_marks.h"
#include "mapping/free/free_space.h"
#include "mapping/map/map.h"
#include "storage/commit/state_tables.h"
#include "storage/rows/map_rows.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// The layers of a map itself: free space and vacated space.

struct MapLayers {
  std::shared_ptr<const FreeSpace> free_space, vacated;
};

/// The layers to write: complete, or without the old place of MapSnapshot::leaving().
struct MapLayersToWrite {
  const FreeSpace& free_space;
  const FreeSpace& vacated;
};

/// Writes the changed tiles of owner `owner_key` and returns the totals of all tiles. `recorder` (may be null) records
/// the blobs of vacated space before and after. FAILED_PRECONDITION if the stored tiles, described by `head`, are not
/// those of `before`.
Result<TileTotals> WriteMapLayers(TileTable& rows, std::int64_t owner_key, const MapRow& head, const StateMarks& before,
                                  const MapLayersToWrite& after, EditTiles* recorder = nullptr);

/// Makes the layers of their rows, in any order.
class MapLayersMaker {
 public:
  /// Errors as ReadMapLayers.
  Status Add(const TileRow& row);
  Result<MapLayers> Finish(const MapRow& map);

 private:
  std::shared_ptr<FreeSpace> free_space_ = std::make_shared<FreeSpace>(), vacated_ = std::make_shared<FreeSpace>();
  TileTotals totals_;
};

/// Reads the tiles of a map and checks them against its row. DATA_LOSS naming a damaged or missing tile,
/// FAILED_PRECONDITION for tiles of a later version's layer.
Result<MapLayers> ReadMapLayers(sqlite::Database& database, const MapRow& map);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/snapshot_reader.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "storage/paging/map_layers.h"
#include "storage/paging/stored_submap.h"
#include "storage/paging/tile_cells.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/submap_rows.h"
#include "storage/rows/tile_rows.h"
#include "storage/submap_maker.h"

namespace dhpmap {
namespace {

/// Whether the tiles can stay unread: their cells are known. `without_cells`: keys of submaps with unknown cells,
/// sorted.
bool CanBeLeftUnread(const SubmapRow& row, const std::vector<std::int64_t>& without_cells) {
  return HasTiles(row) && !std::binary_search(without_cells.begin(), without_cells.end(), row.key);
}

Result<std::vector<std::shared_ptr<const Submap>>> ReadSubmapsWithTiles(sqlite::Database& database, const MapRow& map,
                                                                        std::uint16_t store, ThreadPool& pool,
                                                                        Paging* paging) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> rows, ReadSubmaps(database, map.key));
  if (static_cast<std::int64_t>(rows.size()) != map.num_submaps) {
    return DataLoss("has " + std::to_string(rows.size()) + " submaps, not " + std::to_string(map.num_submaps));
  }
  DHPMAP_ASSIGN_OR_RETURN(TileRowReader tiles, TileRowReader::Prepare(database));
  SubmapMaker maker(store, pool);
  std::vector<std::int64_t> without_cells;
  if (paging != nullptr) {
    DHPMAP_ASSIGN_OR_RETURN(without_cells, OwnersWithoutCells(database, map.key));
    paging->lacks_cells = !without_cells.empty();
    if (paging->lacks_cells && !paging->reads_the_rest)
      return Unavailable("some tiles do not say which blocks they have");
  }
  const auto shared = std::make_shared<SharedTiles>();
  std::vector<std::shared_ptr<const Submap>> submaps;
  submaps.reserve(rows.size());
  for (const SubmapRow& row : rows) {
    std::shared_ptr<const Submap>& submap = submaps.emplace_back();
    if (paging != nullptr && CanBeLeftUnread(row, without_cells)) {
      auto unread = std::make_shared<StoredSubmap>(paging->blobs, store, shared, map.info.name, row);
      DHPMAP_ASSIGN_OR_RETURN(submap, UnreadSubmap(row, std::move(unread)));
    } else {
      maker.Begin(row);
      DHPMAP_RETURN_IF_ERROR(tiles.ForEach(row.key, [&maker](const TileRow& tile) { return maker.Add(tile); }));
      DHPMAP_ASSIGN_OR_RETURN(submap, maker.Finish());
    }
  }
  return submaps;
}

}  // namespace

Result<std::shared_ptr<const MapSnapshot>> ReadSnapshot(sqlite::Database& database, const std::string& name,
                                                        std::uint16_t store, ThreadPool& pool, Paging* paging) {
  DHPMAP_ASSIGN_OR_RETURN(MapRow map, ReadMap(database, name));
  Result<std::vector<std::shared_ptr<const Submap>>> submaps = ReadSubmapsWithTiles(database, map, store, pool, paging);
  if (!submaps.ok()) return DamagedState(name, submaps.status());
  Result<MapLayers> layers = ReadMapLayers(database, map);
  if (!layers.ok()) return DamagedState(name, layers.status());
  return std::make_shared<const MapSnapshot>(std::move(map.info), std::move(submaps).value(),
                                             std::move(layers->free_space),
                                             VacatedSpace{std::move(layers->vacated), map.leaving()});
}

}  // namespace dhpmap

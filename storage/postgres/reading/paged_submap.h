// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "storage/paging/submap_tiles.h"
#include "storage/postgres/reading/page_reader.h"

namespace dhpmap::postgres {

/// The source of a loaded state's tiles that are read on demand.
struct PagedMap {
  std::shared_ptr<PageReader> reader;  ///< null: tiles are read with the map
  std::int64_t map_key = 0;
  std::int64_t revision = 0;  ///< of the loaded state
};

/// A submap whose tiles stay in the database. Lists the tiles, and reads their blocks by key, all layers of a tile in
/// one round trip. A missing blob or changed row is ABORTED, reason SNAPSHOT_EXPIRED, if the map was committed to since
/// it was loaded and no row refers to the blob; else DATA_LOSS. Thread-safe.
class PagedSubmap final : public SubmapTiles {
 public:
  /// See SubmapTiles.
  PagedSubmap(PagedMap map, std::uint16_t store, std::shared_ptr<SharedTiles> shared, const std::string& map_name,
              const SubmapRow& row);

  Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) override;
  Result<std::vector<Tile>> ReadAll() override;
  Result<std::shared_ptr<const BlockTile>> ReadOne(TileIndex index) override;

 private:
  Result<std::vector<BlockEntry>> ReadLayers(Connection& connection, const TileOnDisk& tile) const;
  [[nodiscard]] Status WhyMissing(Connection& connection, std::int64_t blob_key, const std::string& place) const;
  [[nodiscard]] Status WhyOthers(Connection& connection) const;
  /// Of the whole map.
  Result<bool> HasGoneOn(Connection& connection) const;

  const PagedMap map_;
  const std::int64_t owner_id_;
};

}  // namespace dhpmap::postgres

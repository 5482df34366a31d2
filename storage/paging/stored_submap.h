// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/paging/tile_directory.h"
#include "mapping/paging/tile_page.h"
#include "storage/paging/tile_blobs.h"
#include "storage/rows/submap_rows.h"
#include "storage/rows/tile_rows.h"

namespace dhpmap {

/// Storage keys of a tile's layers; 0 for none.
using TileKeys = std::array<std::int64_t, kNumBlockLayers>;

/// Tiles that several submaps of a map refer to, so that clones share them in memory while one is in use. Thread-safe.
class SharedTiles {
 public:
  /// The tile registered under these keys, else registers `made`.
  std::shared_ptr<const BlockTile> Find(const TileKeys& keys, std::shared_ptr<const BlockTile> made)
      DHPMAP_EXCLUDES(mutex_);

 private:
  Mutex mutex_;
  std::map<TileKeys, std::weak_ptr<const BlockTile>> tiles_ DHPMAP_GUARDED_BY(mutex_);
};

/// A submap with its tiles in a store, as of the row that was loaded: lists the tiles and reads their blocks.
/// Thread-safe.
class StoredSubmap final : public TileSource, public TileDirectory, public std::enable_shared_from_this<StoredSubmap> {
 public:
  /// All rows of its tiles know their blocks. `store`: see StoredKey. If the row has no sum of its tiles (schema 6 and
  /// before), all must be read at once.
  StoredSubmap(std::shared_ptr<TileBlobs> blobs, std::uint16_t store, std::shared_ptr<SharedTiles> shared,
               const std::string& map, const SubmapRow& row);

  Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) override { return blobs_->Read(name_, owner_, tile); }
  /// Also DATA_LOSS if the tiles are not those of the row; FAILED_PRECONDITION, reason NEWER_LAYER.
  Result<std::vector<Tile>> ReadAll() override;
  Result<std::shared_ptr<const BlockTile>> ReadOne(TileIndex index) override;
  [[nodiscard]] bool HasFew() const override;

 private:
  /// The rows of one tile.
  struct Rows {
    TileOnDisk tile;
    bool is_shared = false;  ///< another submap may have exactly this tile
  };
  /// Adds a row of the tile.
  Status Add(const TileRowReader::Row& row, Rows& rows) const;
  std::shared_ptr<const BlockTile> Make(const Rows& rows);
  /// Whether these are the tiles of the row that was loaded.
  [[nodiscard]] Status Check(sqlite::Database& database, const SubmapCounts& counts, const TileTotals& totals) const;

  const std::shared_ptr<TileBlobs> blobs_;
  const std::shared_ptr<SharedTiles> shared_;
  const std::string name_;
  const TileOwner owner_;
  const SubmapCounts counts_;
  const std::optional<std::int64_t> tiles_sum_;  ///< nothing if the row has none
  const std::uint16_t store_;
};

}  // namespace dhpmap

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

/// Under which keys a tile's layers are stored; 0 where it has none.
using TileKeys = std::array<std::int64_t, kNumBlockLayers>;

/// Tiles that several submaps of a map refer to, so that clones share them in memory, too, while somebody has them.
/// Thread-safe.
class SharedTiles {
 public:
  /// The tile that is known under these keys, else `made`, which is known from now on.
  std::shared_ptr<const BlockTile> Find(const TileKeys& keys, std::shared_ptr<const BlockTile> made)
      DHPMAP_EXCLUDES(mutex_);

 private:
  Mutex mutex_;
  std::map<TileKeys, std::weak_ptr<const BlockTile>> tiles_ DHPMAP_GUARDED_BY(mutex_);
};

/// A submap whose tiles are left in a store, as its row was when it was loaded: which there are, and their blocks.
/// Thread-safe.
class StoredSubmap final : public TileSource, public TileDirectory, public std::enable_shared_from_this<StoredSubmap> {
 public:
  /// Each row of its tiles says which blocks it has. `store`: see StoredKey. Where the row does not say what its tiles
  /// are together, as those of schema 6 and before, all are to be read at once.
  StoredSubmap(std::shared_ptr<TileBlobs> blobs, std::uint16_t store, std::shared_ptr<SharedTiles> shared,
               const std::string& map, const SubmapRow& row);

  Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) override { return blobs_->Read(name_, owner_, tile); }
  /// DATA_LOSS, too, where they are not those that the row speaks of; FAILED_PRECONDITION, reason NEWER_LAYER.
  Result<std::vector<Tile>> ReadAll() override;
  Result<std::shared_ptr<const BlockTile>> ReadOne(TileIndex index) override;
  [[nodiscard]] bool HasFew() const override;

 private:
  /// What rows say of one tile.
  struct Rows {
    TileOnDisk tile;
    bool is_shared = false;  ///< another submap may have the very same tile
  };
  /// Takes in a row of the tile.
  Status Add(const TileRowReader::Row& row, Rows& rows) const;
  std::shared_ptr<const BlockTile> Make(const Rows& rows);
  /// Whether these are the tiles that it had when its row was read.
  [[nodiscard]] Status Check(sqlite::Database& database, const SubmapCounts& counts, const TileTotals& totals) const;

  const std::shared_ptr<TileBlobs> blobs_;
  const std::shared_ptr<SharedTiles> shared_;
  const std::string name_;
  const TileOwner owner_;
  const SubmapCounts counts_;
  const std::optional<std::int64_t> tiles_sum_;  ///< nothing where its row does not say it
  const std::uint16_t store_;
};

}  // namespace dhpmap

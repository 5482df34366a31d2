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
#include "storage/commit/tile_totals.h"
#include "storage/rows/submap_rows.h"

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

/// A submap with its tiles in a store, as of the row that was loaded: what does not depend on the store's database.
/// Thread-safe.
class SubmapTiles : public TileSource, public TileDirectory, public std::enable_shared_from_this<SubmapTiles> {
 public:
  [[nodiscard]] bool HasFew() const override;

 protected:
  /// All rows of its tiles know their blocks. `store`: see StoredKey. If the row has no sum of its tiles (schema 6 and
  /// before), all must be read at once.
  SubmapTiles(std::uint16_t store, std::shared_ptr<SharedTiles> shared, const std::string& map, const SubmapRow& row);

  /// The rows of one tile.
  struct Rows {
    TileOnDisk tile;
    bool is_shared = false;  ///< another submap may have exactly this tile
  };
  /// Adds a row of the tile.
  Status Add(const TileRow& row, Rows& rows) const;
  std::shared_ptr<const BlockTile> Make(const Rows& rows);

  /// All rows of the submap, by tile.
  class Collector {
   public:
    explicit Collector(SubmapTiles& submap) : submap_(submap) {}
    Status Add(const TileRow& row);
    /// Whether these are not the tiles of the row that was loaded.
    [[nodiscard]] bool AreOthers() const;
    /// DATA_LOSS, to be named by Damaged, if they are others, or have other blocks.
    [[nodiscard]] Status Check() const;
    std::vector<Tile> Tiles();

   private:
    SubmapTiles& submap_;
    std::vector<Rows> all_;
    TileTotals totals_;
  };

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::optional<std::int64_t>& tiles_sum() const { return tiles_sum_; }
  /// DATA_LOSS, reason DAMAGED_MAP.
  [[nodiscard]] Status Damaged(const Status& what) const;

 private:
  const std::shared_ptr<SharedTiles> shared_;
  const std::string name_;
  const SubmapCounts counts_;
  const std::optional<std::int64_t> tiles_sum_;  ///< nothing if the row has none
  const std::uint16_t store_;
};

/// DATA_LOSS, to be named by SubmapTiles::Damaged.
Status OtherTiles();

/// Whether a submap has tiles, which then can be left in the store.
bool HasTiles(const SubmapRow& row);
/// The submap of a row, with its tiles left in the store. Where nothing would tell later whether they are still the
/// same, they are listed now: errors as TileDirectory.
Result<std::shared_ptr<const Submap>> UnreadSubmap(const SubmapRow& row, std::shared_ptr<SubmapTiles> tiles);

/// ABORTED, reason SNAPSHOT_EXPIRED. `what`: the subject of the sentence.
Status Expired(const std::string& what);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "mapping/voxels/block_table.h"
#include "mapping/voxels/table_loader.h"
#include "mapping/voxels/tile_marks.h"

namespace dhpmap {

/// Lists the tiles of a submap, from a store. Thread-safe.
///
/// It describes the state in which the submap was loaded. Writers read all tiles before they change one (BlockTable),
/// so the newest state never depends on it after a commit. Readers of a state from before the map was loaded again may
/// get ABORTED, reason SNAPSHOT_EXPIRED. Other errors as of TileSource.
class TileDirectory {
 public:
  virtual ~TileDirectory() = default;
  struct Tile {
    TileIndex index;
    std::shared_ptr<const BlockTile> tile;  ///< neither null nor empty
  };
  /// At least one tile.
  virtual Result<std::vector<Tile>> ReadAll() = 0;
  /// Null if there is no such tile. Need not detect that other tiles are missing.
  virtual Result<std::shared_ptr<const BlockTile>> ReadOne(TileIndex index) = 0;
  /// Whether there are so few tiles that reading one costs about as much as reading all.
  [[nodiscard]] virtual bool HasFew() const = 0;
};

/// Marks of tiles that are not read yet; available once they are. Thread-safe.
class UnreadMarks final : public MarkLoader {
 public:
  explicit UnreadMarks(std::shared_ptr<TileDirectory> directory) : directory_(std::move(directory)) {}

  [[nodiscard]] const TileMarkTable& Read() const override DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] const TileMarkTable* IfRead() const override {
    return is_read_.load(std::memory_order_acquire) ? &table_ : nullptr;
  }
  /// Call after reading the tiles.
  void Fill(std::span<const TileEntry> tiles) const DHPMAP_EXCLUDES(mutex_);

 private:
  void FillNow(std::span<const TileEntry> tiles) const DHPMAP_REQUIRES(mutex_);

  const std::shared_ptr<TileDirectory> directory_;
  mutable Mutex mutex_;
  mutable std::atomic<bool> is_read_ = false;
  mutable TileMarkTable table_;  ///< written once, before is_read_
};

/// Loads the tiles of a submap from a directory. Thread-safe.
class UnreadTiles final : public TableLoader {
 public:
  explicit UnreadTiles(std::shared_ptr<TileDirectory> directory)
      : directory_(directory),
        own_marks_(std::make_shared<const UnreadMarks>(std::move(directory))),
        marks_(own_marks_) {}

  [[nodiscard]] const BlockEntry* Find(BlockIndex index) const override DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] const BlockTable& Read() const override DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] bool HoldsBlocks() const override DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] const std::shared_ptr<const MarkLoader>& marks() const override { return marks_; }

 private:
  const BlockTable& ReadNow() const DHPMAP_REQUIRES(mutex_);
  /// Null if there is no such tile.
  const BlockTile* ReadOne(TileIndex index) const DHPMAP_REQUIRES(mutex_);

  const std::shared_ptr<TileDirectory> directory_;
  const std::shared_ptr<const UnreadMarks> own_marks_;
  const std::shared_ptr<const MarkLoader> marks_;  ///< the same
  mutable Mutex mutex_;                            ///< held while reading
  /// Tiles read one by one; null: there is none. They stay valid when all are read.
  mutable std::vector<TileDirectory::Tile> some_ DHPMAP_GUARDED_BY(mutex_);
  mutable int num_lookups_ DHPMAP_GUARDED_BY(mutex_) = 0;
  mutable std::unique_ptr<const BlockTable> table_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/voxels/block_tile.h"
#include "mapping/voxels/kept_extent.h"
#include "mapping/voxels/table_loader.h"

namespace dhpmap {

/// One tile of a table, shared with every copy of the table that holds the same state.
struct TileEntry {
  TileIndex index;
  std::shared_ptr<const BlockTile> tile;  ///< never null, never empty
  std::uint64_t generation = 0;           ///< of the writer that made it; see BlockTable
  bool is_forked = false;                 ///< a fork shares it; see BlockTable::ForkTiles
};

/// Returns the same tile (by PartId) as another object, such as an evicted one. Null: keep the present one.
using OtherTile = std::function<std::shared_ptr<const BlockTile>(const BlockTile&)>;

/// Blocks by their index, in tiles. Copying shares the tiles and takes some bytes per tile; two copies are compared
/// tile by tile. A writer names its generation, which must be new after each copy of the table: it copies a tile of
/// another generation before it writes to it. Thread-compatible.
///
/// A table made of a TableLoader leaves its tiles on disk until more than a few blocks are requested. That read throws
/// StatusError if it fails. Writing reads all tiles first.
class BlockTable {
 public:
  BlockTable() = default;
  /// Not null, and not without tiles.
  explicit BlockTable(std::shared_ptr<const TableLoader> unread) : unread_(std::move(unread)) {}

  /// Number of blocks. Throws StatusError, and so do the functions below unless they read nothing.
  [[nodiscard]] std::size_t size() const { return Read().num_blocks_; }
  /// Reads nothing.
  [[nodiscard]] bool empty() const { return num_blocks_ == 0 && unread_ == nullptr; }

  /// Null if the block is not there. Valid until the table is next written to.
  [[nodiscard]] const BlockEntry* Find(BlockIndex index) const {
    const std::uint32_t tile = numbers_.Find(TileOf(index));
    if (tile == kNone) [[unlikely]]
      return FindElsewhere(index);
    return tiles_[tile].tile->Find(CellOf(index));
  }
  /// Null if the tile is not there. Valid until the table is next written to.
  [[nodiscard]] const TileEntry* FindTile(TileIndex index) const {
    const BlockTable& table = Read();
    const std::uint32_t tile = table.numbers_.Find(index);
    return tile == kNone ? nullptr : &table.tiles_[tile];
  }

  /// In order of allocation; erasing the last block of a tile moves the last tile into the gap.
  [[nodiscard]] std::span<const TileEntry> tiles() const { return Read().tiles_; }
  /// Empty until the tiles have been read. Reads nothing.
  [[nodiscard]] std::span<const TileEntry> tiles_if_read() const;
  /// The loader of a table that has not been written to since it was loaded; else null. Reads nothing.
  [[nodiscard]] const std::shared_ptr<const TableLoader>& unread() const { return unread_; }

  /// Whether both hold the same unread loader. Reads nothing.
  [[nodiscard]] bool SharesUnread(const BlockTable& other) const {
    return unread_ != nullptr && unread_ == other.unread_;
  }

  /// All blocks, tile by tile: a forward range of const BlockEntry&.
  class Range;
  [[nodiscard]] Range entries() const;

  /// An entry of a tile that the writer of `generation` made; null: there is none.
  struct OwnEntry {
    const BlockEntry* entry = nullptr;
    bool is_forked = false;  ///< the tile is forked (ForkTiles)
  };
  /// For writing layers in place, without copying a forked tile.
  OwnEntry FindOwn(BlockIndex index, std::uint64_t generation);
  /// Finds the entry or adds one without layers. Invalidates pointers to entries.
  BlockEntry& FindOrInsert(BlockIndex index, std::uint64_t generation);
  /// Inserts a tile of a loaded map as it is; the index must be free. Neither null nor empty.
  void PutTile(TileIndex index, std::shared_ptr<const BlockTile> tile);
  /// Replaces the given layers of a tile by those of `from` (null: removes them) and removes blocks without any layer
  /// left. Storage keys of both stay known.
  void PutLayers(TileIndex index, const BlockTile* from, const BlockLayers& layers);
  /// Returns whether the block was there. Invalidates pointers to entries.
  bool Erase(BlockIndex index, std::uint64_t generation);
  /// Calls visit(BlockEntry&) for all blocks; it must not change an index.
  template <typename Visitor>
  void ForEachMutable(std::uint64_t generation, Visitor&& visit) {
    BeginWriting();
    for (TileEntry& tile : tiles_) {
      for (BlockEntry& entry : Own(tile, generation).mutable_entries()) visit(entry);
    }
  }
  /// Replaces tiles by other objects with the same blocks, such as evicted ones (TileEvictor). Other tables keep
  /// theirs. Returns whether any was replaced.
  bool Replace(const OtherTile& other);
  /// Marks every tile as shared, whatever its generation: for two copies that continue with the same generation.
  void ShareTiles();
  /// Makes the writer copy each tile before its next write. Blocks that the writer allocated stay writable in place, as
  /// `owned` ones (BlockEntry). For a table of which a copy is kept for rollback.
  void ForkTiles();

  /// Cached SphereOfObserved, valid until the table is next written to.
  [[nodiscard]] const KeptExtent& extent() const { return extent_; }

  [[nodiscard]] std::size_t MemoryBytes() const;

 private:
  static constexpr std::uint32_t kNone = IndexMap<TileIndex>::kNone;
  static BlockTile& Own(TileEntry& entry, std::uint64_t generation);
  /// This table, or the one that has read the tiles.
  [[nodiscard]] const BlockTable& Read() const { return unread_ == nullptr ? *this : ReadTiles(); }
  [[nodiscard]] const BlockTable& ReadTiles() const {
    const BlockTable* all = unread_->IfRead();
    return all != nullptr ? *all : unread_->Read();
  }
  /// Finds a block through the loader.
  [[nodiscard]] const BlockEntry* FindElsewhere(BlockIndex index) const;
  /// Takes over the loader's tiles.
  void TakeTiles();
  /// The same if some blocks are in memory and the rest can be read. Returns whether it did.
  bool TakeTilesInMemory();
  void BeginWriting() {
    extent_.Forget();
    if (unread_ != nullptr) TakeTiles();
  }
  void EraseTile(std::uint32_t number);

  std::vector<TileEntry> tiles_;
  IndexMap<TileIndex> numbers_;  ///< position in tiles_
  std::size_t num_blocks_ = 0;
  std::shared_ptr<const TableLoader>
      unread_;  ///< replaces the three above until the tiles are read; null: they are valid
  KeptExtent extent_;
};

class BlockTable::Range {
 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = BlockEntry;
    using difference_type = std::ptrdiff_t;
    using pointer = const BlockEntry*;
    using reference = const BlockEntry&;

    Iterator() = default;
    Iterator(const TileEntry* tile, const TileEntry* end) : tile_(tile), end_(end) { Enter(); }
    reference operator*() const { return *entry_; }
    pointer operator->() const { return entry_; }
    Iterator& operator++() {
      if (++entry_ == last_) {
        ++tile_;
        Enter();
      }
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return entry_ == other.entry_; }

   private:
    void Enter() {
      const std::span<const BlockEntry> entries =
          tile_ == end_ ? std::span<const BlockEntry>() : tile_->tile->entries();
      entry_ = entries.data();
      last_ = entry_ + entries.size();
    }
    const TileEntry* tile_ = nullptr;
    const TileEntry* end_ = nullptr;
    const BlockEntry* entry_ = nullptr;  ///< null at the end
    const BlockEntry* last_ = nullptr;
  };

  explicit Range(std::span<const TileEntry> tiles) : tiles_(tiles) {}
  [[nodiscard]] Iterator begin() const { return {tiles_.data(), tiles_.data() + tiles_.size()}; }
  [[nodiscard]] Iterator end() const { return {tiles_.data() + tiles_.size(), tiles_.data() + tiles_.size()}; }
  /// Requires at least one block.
  [[nodiscard]] const BlockEntry& front() const { return *begin(); }

 private:
  std::span<const TileEntry> tiles_;
};

inline BlockTable::Range BlockTable::entries() const { return Range(tiles()); }

}  // namespace dhpmap

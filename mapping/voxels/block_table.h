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
};

/// Gives the same tile as another object, whose blocks are elsewhere: of the same name (PartId). Null: it stays as it
/// is.
using OtherTile = std::function<std::shared_ptr<const BlockTile>(const BlockTile&)>;

/// Blocks by their index, in tiles. Copying shares the tiles, so it costs some bytes a tile, and two copies are
/// compared tile by tile. A writer names its generation, which must be new after each copy of the table: a tile of
/// another generation is copied before it is written to. Thread-compatible.
///
/// One that is made of a TableLoader has its tiles on the disk until somebody asks for more than a few blocks; who does
/// throws StatusError if they cannot be read. Who writes to it reads them first.
class BlockTable {
 public:
  BlockTable() = default;
  /// Neither null nor of no tile.
  explicit BlockTable(std::shared_ptr<const TableLoader> unread) : unread_(std::move(unread)) {}

  /// Number of blocks. Throws StatusError, as all that follows.
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
  /// None as long as nobody has read them. Reads nothing.
  [[nodiscard]] std::span<const TileEntry> tiles_if_read() const;
  /// Null where it was written to since it was loaded, or came whole. Reads nothing.
  [[nodiscard]] const std::shared_ptr<const TableLoader>& unread() const { return unread_; }

  /// Whether both are known to have the same tiles, as they were loaded. Reads nothing.
  [[nodiscard]] bool SharesUnread(const BlockTable& other) const {
    return unread_ != nullptr && unread_ == other.unread_;
  }

  /// All blocks, tile by tile: a forward range of const BlockEntry&.
  class Range;
  [[nodiscard]] Range entries() const;

  /// Finds the entry or adds one without layers. Invalidates pointers to entries.
  BlockEntry& FindOrInsert(BlockIndex index, std::uint64_t generation);
  /// Puts a tile in place as it is (a loaded map), where there is none yet. Neither null nor empty.
  void PutTile(TileIndex index, std::shared_ptr<const BlockTile> tile);
  /// Has some layers of a tile be those of `from` (null: nothing), and the others as they are; blocks that then have no
  /// layer go. What a store knows of either stays known.
  void PutLayers(TileIndex index, const BlockTile* from, const BlockLayers& layers);
  /// Returns whether it was there. Invalidates pointers to entries.
  bool Erase(BlockIndex index, std::uint64_t generation);
  /// Calls visit(BlockEntry&) for all blocks; it leaves every index as it is.
  template <typename Visitor>
  void ForEachMutable(std::uint64_t generation, Visitor&& visit) {
    BeginWriting();
    for (TileEntry& tile : tiles_) {
      for (BlockEntry& entry : Own(tile, generation).mutable_entries()) visit(entry);
    }
  }
  /// Puts other objects of the same tiles in place, which others than this table need not have: their blocks are left
  /// on the disk (TileEvictor), while other tables keep theirs. Returns whether there were any.
  bool Replace(const OtherTile& other);
  /// Makes every tile count as shared, whatever its generation: for two copies that go on with the same one.
  void ShareTiles();

  /// SphereOfObserved, as found by whoever asked for it first since the table was last written to.
  [[nodiscard]] const KeptExtent& extent() const { return extent_; }

  [[nodiscard]] std::size_t MemoryBytes() const;

 private:
  static constexpr std::uint32_t kNone = IndexMap<TileIndex>::kNone;
  static BlockTile& Own(TileEntry& entry, std::uint64_t generation);
  /// The table that has the tiles.
  [[nodiscard]] const BlockTable& Read() const { return unread_ == nullptr ? *this : ReadTiles(); }
  [[nodiscard]] const BlockTable& ReadTiles() const {
    const BlockTable* all = unread_->IfRead();
    return all != nullptr ? *all : unread_->Read();
  }
  /// Of a tile that this table does not have.
  [[nodiscard]] const BlockEntry* FindElsewhere(BlockIndex index) const;
  /// Has the tiles be its own.
  void TakeTiles();
  /// Likewise, where blocks of some may be in memory and all can be read. Returns whether it has.
  bool TakeTilesInMemory();
  void BeginWriting() {
    extent_.Forget();
    if (unread_ != nullptr) TakeTiles();
  }
  void EraseTile(std::uint32_t number);

  std::vector<TileEntry> tiles_;
  IndexMap<TileIndex> numbers_;  ///< position in tiles_
  std::size_t num_blocks_ = 0;
  std::shared_ptr<const TableLoader> unread_;  ///< instead of the three above; null: those are right
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

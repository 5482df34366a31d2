// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mapping/voxels/block_entry.h"
#include "mapping/voxels/part_id.h"
#include "mapping/voxels/stored_key.h"
#include "mapping/voxels/tile_extent.h"
#include "mapping/voxels/tile_labels.h"
#include "mapping/voxels/tile_loader.h"

namespace dhpmap {

/// The blocks of a tile, by ascending cell. Thread-compatible.
///
/// One that is made of a TileLoader has its blocks on the disk until they are first asked for; who does throws
/// StatusError if they cannot be read. It is never written to: a copy, which is, has them in memory.
class BlockTile {
 public:
  BlockTile() = default;
  /// Neither null nor of no block.
  explicit BlockTile(std::shared_ptr<const TileLoader> loader)
      : cells_(loader->cells()), extent_(loader->tile().extent), loader_(std::move(loader)) {
    part_id_.Restore(loader_->names().tile());
    const TileOnDisk& there = loader_->tile();
    for (std::size_t i = 0; i < kNumBlockLayers; ++i) stored_[i].Set(there.store, there.keys[i]);
  }
  /// With the same blocks, in memory. Throws StatusError.
  BlockTile(const BlockTile& other);
  BlockTile& operator=(const BlockTile& other) = delete;
  BlockTile(BlockTile&& other) = default;
  BlockTile& operator=(BlockTile&& other) = default;

  [[nodiscard]] bool empty() const { return cells_ == 0; }
  /// Number of blocks; reads none.
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(std::popcount(cells_)); }
  /// Bit c: there is a block at cell c. Reads none.
  [[nodiscard]] std::uint64_t cells() const { return cells_; }
  /// The cells of blocks that have a layer. Reads none.
  [[nodiscard]] std::uint64_t CellsWith(BlockLayer layer) const;
  /// Throws StatusError.
  [[nodiscard]] std::span<const BlockEntry> entries() const {
    if (loader_ != nullptr) [[unlikely]]
      return loader_->blocks();
    return entries_;
  }
  /// The caller leaves every index as it is. Only of blocks in memory.
  [[nodiscard]] std::span<BlockEntry> mutable_entries() {
    ForgetWhatWasFound();
    return entries_;
  }

  /// Null if there is no block at this cell. Throws StatusError.
  [[nodiscard]] const BlockEntry* Find(int cell) const {
    return (cells_ >> cell & 1u) != 0 ? entries().data() + PositionOf(cell) : nullptr;
  }
  /// Finds the entry or adds one without layers. May invalidate pointers to entries. Only of blocks in memory.
  BlockEntry& FindOrInsert(BlockIndex index);
  /// Returns whether it was there. Only of blocks in memory.
  bool Erase(int cell);

  /// Around what is observed, if that is known; reads none.
  [[nodiscard]] std::optional<TileExtent> KnownExtent() const { return extent_.Find(); }
  /// Likewise; what has to be read for it goes again, and the extent stays known until the tile is written to. Throws
  /// StatusError.
  [[nodiscard]] TileExtent Extent() const;

  /// Adds what its voxels have seen: counted when it is first asked for, until the tile is written to. Of a tile on the
  /// disk that is kept if it is a short list, and what has to be read for it goes again, if it can. Throws StatusError.
  void AddLabelsTo(LabelTotals& totals) const;
  /// What that takes in memory, beside the blocks.
  [[nodiscard]] std::size_t LabelsBytes() const { return labels_.MemoryBytes(); }

  /// Of the label blocks in memory, what LabelBlock::CountedBytes counts; reads none, and is no use of any.
  [[nodiscard]] std::size_t LabelPlaneBytes() const {
    return loader_ != nullptr ? loader_->LabelPlaneBytes() : LabelPlaneBytesOf(entries_);
  }

  /// Where a store has a layer of all blocks. Meaningful while nobody writes to the tile.
  [[nodiscard]] const StoredKey& stored(BlockLayer layer) const { return stored_[static_cast<std::size_t>(layer)]; }

  /// The same for tiles that were let go of and read again.
  [[nodiscard]] std::uint64_t part_id() const { return part_id_.value(); }
  /// Null: its blocks have been in memory all along.
  [[nodiscard]] const std::shared_ptr<const TileLoader>& loader() const { return loader_; }
  /// Whether its blocks were read from where the store has them now, so that they can be left there again.
  [[nodiscard]] bool CanBeUnread() const;
  /// Whether its blocks are in memory, have been so all along, and each has something.
  [[nodiscard]] bool CanBeLeft() const;
  /// The same tile with its blocks left to a loader that has them just as they are.
  [[nodiscard]] std::shared_ptr<const BlockTile> LeftTo(std::shared_ptr<const TileLoader> loader) const;
  /// Whether its blocks are in memory.
  [[nodiscard]] bool IsRead() const { return loader_ == nullptr || loader_->IsRead(); }

  /// Of what is in memory, but for what was found of it meanwhile (LabelsBytes): the same for the same blocks.
  [[nodiscard]] std::size_t MemoryBytes() const;

 private:
  [[nodiscard]] std::size_t PositionOf(int cell) const {
    return static_cast<std::size_t>(std::popcount(cells_ & ((std::uint64_t{1} << cell) - 1)));
  }

  void ForgetWhatWasFound() {
    extent_.Forget();
    labels_.Forget();
  }

  /// Of a tile of the same blocks.
  void KeepShortLabelsOf(const BlockTile& other);

  PartId part_id_;
  std::uint64_t cells_ = 0;  ///< bit c: there is a block at cell c
  KeptTileExtent extent_;
  KeptTileLabels labels_;
  std::vector<BlockEntry> entries_;
  std::array<StoredKey, kNumBlockLayers> stored_;
  std::shared_ptr<const TileLoader> loader_;
};
static_assert(kTileBlocks <= 64, "one bit a block");

/// The blocks of a tile for who goes through a whole map once: what it reads from the disk goes with it, and what
/// others have read stays. Blocks that are to last longer are copied (BlockEntry). Thread-compatible.
class ScannedTile {
 public:
  /// `tile` lives longer. Throws StatusError.
  explicit ScannedTile(const BlockTile& tile) : entries_(Read(tile)) {}
  ScannedTile(const ScannedTile&) = delete;
  ScannedTile& operator=(const ScannedTile&) = delete;

  /// By ascending cell.
  [[nodiscard]] std::span<const BlockEntry> entries() const { return entries_; }

 private:
  std::span<const BlockEntry> Read(const BlockTile& tile);

  std::shared_ptr<const TileLoader> own_;  ///< before what is in it
  std::span<const BlockEntry> entries_;
};

}  // namespace dhpmap

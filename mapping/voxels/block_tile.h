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
/// A tile made of a TileLoader leaves its blocks on disk until they are first requested; that throws StatusError if it
/// fails. Such a tile is never written to: writers copy it, which reads the blocks.
class BlockTile {
 public:
  BlockTile() = default;
  /// Not null, and not without blocks.
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
  /// The caller must not change an index. Only for blocks in memory.
  [[nodiscard]] std::span<BlockEntry> mutable_entries() {
    ForgetWhatWasFound();
    return entries_;
  }

  /// Null if there is no block at this cell. Throws StatusError.
  [[nodiscard]] const BlockEntry* Find(int cell) const {
    return (cells_ >> cell & 1u) != 0 ? entries().data() + PositionOf(cell) : nullptr;
  }
  /// Finds the entry or adds one without layers. May invalidate pointers to entries. Only for blocks in memory.
  BlockEntry& FindOrInsert(BlockIndex index);
  /// Returns whether the block was there. Only for blocks in memory.
  bool Erase(int cell);

  /// Extent of the observed voxels if known; reads nothing.
  [[nodiscard]] std::optional<TileExtent> KnownExtent() const { return extent_.Find(); }
  /// The extent, kept until the tile is written to. Evicts the blocks that it had to read. Throws StatusError.
  [[nodiscard]] TileExtent Extent() const;

  /// Adds the label counts of all voxels. They are counted at the first call and cached until the tile is written to;
  /// for a tile on disk only if the list is short. Evicts the blocks that it had to read, if possible. Throws
  /// StatusError.
  void AddLabelsTo(LabelTotals& totals) const;
  /// Memory of that cache.
  [[nodiscard]] std::size_t LabelsBytes() const { return labels_.MemoryBytes(); }

  /// Sum of LabelBlock::CountedBytes over the blocks in memory. Reads nothing, and does not count as use.
  [[nodiscard]] std::size_t LabelPlaneBytes() const {
    return loader_ != nullptr ? loader_->LabelPlaneBytes() : LabelPlaneBytesOf(entries_);
  }

  /// Storage key of a layer of all blocks. Valid until the tile is written to.
  [[nodiscard]] const StoredKey& stored(BlockLayer layer) const { return stored_[static_cast<std::size_t>(layer)]; }

  /// Stays the same when the tile is evicted and read again.
  [[nodiscard]] std::uint64_t part_id() const { return part_id_.value(); }
  /// Null for a tile that was never on disk.
  [[nodiscard]] const std::shared_ptr<const TileLoader>& loader() const { return loader_; }
  /// Whether the tile can be evicted to where its blocks were read from.
  [[nodiscard]] bool CanBeUnread() const;
  /// Whether the tile was never on disk and each of its blocks has content, so that it can be spilled.
  [[nodiscard]] bool CanBeLeft() const;
  /// The same tile, backed by a loader of identical blocks.
  [[nodiscard]] std::shared_ptr<const BlockTile> LeftTo(std::shared_ptr<const TileLoader> loader) const;
  /// Whether its blocks are in memory.
  [[nodiscard]] bool IsRead() const { return loader_ == nullptr || loader_->IsRead(); }

  /// Memory of the blocks, without the cache (LabelsBytes): equal for equal blocks.
  [[nodiscard]] std::size_t MemoryBytes() const;

 private:
  [[nodiscard]] std::size_t PositionOf(int cell) const {
    return static_cast<std::size_t>(std::popcount(cells_ & ((std::uint64_t{1} << cell) - 1)));
  }

  void ForgetWhatWasFound() {
    extent_.Forget();
    labels_.Forget();
  }

  /// Takes over the cached counts of a tile with the same blocks.
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

/// The blocks of a tile, for a single pass over a whole map: blocks that it reads from disk are released with it,
/// blocks in memory stay. Copy a BlockEntry to keep it longer. Thread-compatible.
class ScannedTile {
 public:
  /// `tile` must outlive this. Throws StatusError.
  explicit ScannedTile(const BlockTile& tile) : entries_(Read(tile)) {}
  ScannedTile(const ScannedTile&) = delete;
  ScannedTile& operator=(const ScannedTile&) = delete;

  /// By ascending cell.
  [[nodiscard]] std::span<const BlockEntry> entries() const { return entries_; }

 private:
  std::span<const BlockEntry> Read(const BlockTile& tile);

  std::shared_ptr<const TileLoader> own_;  ///< must precede the entries that refer to it
  std::span<const BlockEntry> entries_;
};

}  // namespace dhpmap

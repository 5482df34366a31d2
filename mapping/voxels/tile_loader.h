// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mapping/voxels/block_entry.h"
#include "mapping/voxels/part_names.h"

namespace dhpmap {

/// What is known of a tile whose blocks are not in memory.
struct TileOnDisk {
  TileIndex index;
  LayerCells cells{};
  std::array<std::int64_t, kNumBlockLayers> keys{};  ///< under which a store has each layer; 0 where it has none
  std::uint16_t store = 0;                           ///< which one: see StoredKey
  std::uint64_t extent = 0;                          ///< TileExtent::Code; 0: not known
};

/// The blocks of a tile that are read when somebody first asks for them: what a BlockTile has in place of its own.
/// Blocks that were read stay for as long as the loader does. They have names (PartId) before they are read.
/// Thread-safe.
class TileLoader {
 public:
  virtual ~TileLoader() = default;
  TileLoader(const TileLoader&) = delete;
  TileLoader& operator=(const TileLoader&) = delete;

  [[nodiscard]] const TileOnDisk& tile() const { return tile_; }
  /// Of all layers together.
  [[nodiscard]] std::uint64_t cells() const { return AnyOf(tile_.cells); }
  [[nodiscard]] const PartNames& names() const { return names_; }
  /// Of a block's layer; 0 if it has none.
  [[nodiscard]] std::uint64_t PartIdOf(BlockLayer layer, int cell) const { return names_.Of(tile_.cells, layer, cell); }
  /// Whether its blocks were in memory before, so that they are read as they were.
  [[nodiscard]] bool HasOwnNames() const { return !names_.AreDrawn(); }

  /// By ascending cell; reads them if nobody has. Valid as long as the loader. Throws StatusError; the next call tries
  /// again.
  [[nodiscard]] std::span<const BlockEntry> blocks() const {
    if (!is_used_.load(std::memory_order_relaxed)) is_used_.store(true, std::memory_order_relaxed);
    if (IsRead()) CountHit();
    else Load();
    return blocks_;
  }
  [[nodiscard]] bool IsRead() const { return is_read_.load(std::memory_order_acquire); }
  /// Whether somebody has asked for the blocks since this was last asked.
  [[nodiscard]] bool WasUsed() const { return is_used_.exchange(false, std::memory_order_relaxed); }

  /// Another loader of the same blocks, with nothing read: they are left on the disk again, for who has this one no
  /// longer.
  [[nodiscard]] virtual std::shared_ptr<const TileLoader> LetGo() const = 0;
  /// Another one that has read them, for who goes through them once: it counts for no request. Throws StatusError.
  [[nodiscard]] virtual std::shared_ptr<const TileLoader> ReadInPassing() const = 0;

  /// Of this itself.
  [[nodiscard]] virtual std::size_t OwnBytes() const = 0;
  /// Of the blocks, if they are read.
  [[nodiscard]] std::size_t BlockBytes() const { return IsRead() ? num_bytes_ : 0; }
  /// Likewise, what LabelBlock::CountedBytes counts.
  [[nodiscard]] std::size_t LabelPlaneBytes() const { return IsRead() ? num_label_plane_bytes_ : 0; }

  /// Times that any loader of the process had its blocks in memory; each thread keeps up to 255 back.
  static std::uint64_t NumHits();

 protected:
  /// `names`: of blocks that were in memory before.
  explicit TileLoader(const TileOnDisk& tile, PartNames names) : tile_(tile), names_(std::move(names)) {}

  /// Sees to it that the blocks are read. Throws StatusError.
  virtual void Load() const = 0;
  /// To be called once, by Load, with no other thread in it.
  void SetBlocks(std::vector<BlockEntry> blocks) const;

 private:
  /// A lookup must cost no atomic: each thread adds up many before it tells.
  static void CountHit() {
    if (++hits_of_thread_ == kHitsAtOnce) [[unlikely]]
      AddHits();
  }
  static void AddHits();
  static constexpr std::uint32_t kHitsAtOnce = 256;
  static inline constinit thread_local std::uint32_t hits_of_thread_ = 0;

  const TileOnDisk tile_;
  const PartNames names_;
  mutable std::atomic<bool> is_read_ = false;
  mutable std::atomic<bool> is_used_ = false;
  // Written once, before is_read_.
  mutable std::vector<BlockEntry> blocks_;
  mutable std::size_t num_bytes_ = 0, num_label_plane_bytes_ = 0;
};

}  // namespace dhpmap

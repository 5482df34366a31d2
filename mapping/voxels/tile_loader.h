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

/// Metadata of a tile on disk.
struct TileOnDisk {
  TileIndex index;
  LayerCells cells{};
  std::array<std::int64_t, kNumBlockLayers> keys{};  ///< storage key of each layer; 0 for none
  std::uint16_t store = 0;                           ///< which one: see StoredKey
  std::uint64_t extent = 0;                          ///< TileExtent::Code; 0: not known
};

/// Loads the blocks of a tile at the first request; a BlockTile holds it in place of its own blocks. Loaded blocks stay
/// in memory as long as the loader. They have their names (PartId) before they are read. Thread-safe.
class TileLoader {
 public:
  virtual ~TileLoader() = default;
  TileLoader(const TileLoader&) = delete;
  TileLoader& operator=(const TileLoader&) = delete;

  [[nodiscard]] const TileOnDisk& tile() const { return tile_; }
  /// Of all layers together.
  [[nodiscard]] std::uint64_t cells() const { return AnyOf(tile_.cells); }
  [[nodiscard]] const PartNames& names() const { return names_; }
  /// Name of a block's layer; 0 if it has none.
  [[nodiscard]] std::uint64_t PartIdOf(BlockLayer layer, int cell) const { return names_.Of(tile_.cells, layer, cell); }
  /// Whether its blocks were in memory before, so that they keep their names.
  [[nodiscard]] bool HasOwnNames() const { return !names_.AreDrawn(); }

  /// By ascending cell; reads them if necessary. Valid as long as the loader. Throws StatusError; the next call tries
  /// again.
  [[nodiscard]] std::span<const BlockEntry> blocks() const {
    if (!is_used_.load(std::memory_order_relaxed)) is_used_.store(true, std::memory_order_relaxed);
    if (IsRead()) CountHit();
    else Load();
    return blocks_;
  }
  [[nodiscard]] bool IsRead() const { return is_read_.load(std::memory_order_acquire); }
  /// Whether the blocks were requested since the last call.
  [[nodiscard]] bool WasUsed() const { return is_used_.exchange(false, std::memory_order_relaxed); }

  /// A new loader of the same blocks, evicted: states that switch to it release the memory.
  [[nodiscard]] virtual std::shared_ptr<const TileLoader> Evicted() const = 0;
  /// A new loader that has read them, for a single pass; it does not count as use. Throws StatusError.
  [[nodiscard]] virtual std::shared_ptr<const TileLoader> ReadInPassing() const = 0;

  /// Memory of the loader itself.
  [[nodiscard]] virtual std::size_t OwnBytes() const = 0;
  /// Memory of the blocks, if they are read.
  [[nodiscard]] std::size_t BlockBytes() const { return IsRead() ? num_bytes_ : 0; }
  /// Likewise, the part that LabelBlock::CountedBytes counts.
  [[nodiscard]] std::size_t LabelPlaneBytes() const { return IsRead() ? num_label_plane_bytes_ : 0; }

  /// Number of requests, over all loaders of the process, that found their blocks in memory. Each thread may hold back
  /// up to 255.
  static std::uint64_t NumHits();

 protected:
  /// `names`: of blocks that were in memory before.
  explicit TileLoader(const TileOnDisk& tile, PartNames names) : tile_(tile), names_(std::move(names)) {}

  /// Reads the blocks and calls SetBlocks. Throws StatusError.
  virtual void Load() const = 0;
  /// Load calls it once, under its own lock.
  void SetBlocks(std::vector<BlockEntry> blocks) const;

 private:
  /// Avoids an atomic in each lookup: threads count locally and report in batches.
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
  // Written once, before is_read_ is set.
  mutable std::vector<BlockEntry> blocks_;
  mutable std::size_t num_bytes_ = 0, num_label_plane_bytes_ = 0;
};

}  // namespace dhpmap

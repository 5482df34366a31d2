// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "mapping/map/block_entry.h"
#include "mapping/map/part_names.h"

namespace dhpmap {

/// What is known of a tile whose blocks are on the disk.
struct TileOnDisk {
  TileIndex index;
  LayerCells cells{};
  std::array<std::int64_t, kNumBlockLayers> keys{};  ///< under which a store has each layer; 0 where it has none
  std::uint16_t store = 0;                           ///< which one: see StoredKey
  std::uint64_t extent = 0;                          ///< TileExtent::Code; 0: not known
};

/// Where blocks are read from that were left on the disk: a store. Thread-safe.
class TileSource {
 public:
  virtual ~TileSource() = default;
  /// The blocks, by ascending cell. Errors name the tile: DATA_LOSS if they are damaged or missing; ABORTED, reason
  /// SNAPSHOT_EXPIRED, if the map, opened a second time since, was changed so that nothing needs them any more;
  /// UNAVAILABLE once the store is closed; errors of the disk.
  virtual Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) = 0;
};

/// The blocks of a tile, left on the disk until somebody reads them. Blocks that were read stay for as long as the page
/// does. Its blocks have names (PartId) before they are read. Thread-safe.
///
/// A store keeps no blob for the sake of a page. It need not: who changes a tile of the newest state reads it first, so
/// what older states have of it is in memory before its blobs can go; Map::Remove reads what nobody has. That holds of
/// states that go on from one another: who has one of a map that was loaded anew since may be told ABORTED.
class TilePage {
 public:
  /// `source` is not null. `names`: of blocks that were in memory before.
  TilePage(const TileOnDisk& tile, std::shared_ptr<TileSource> source, PartNames names = PartNames::Draw())
      : tile_(tile), source_(std::move(source)), names_(std::move(names)) {}
  /// Another page of the same blocks, under the same names, with nothing read.
  TilePage(const TilePage& other) : tile_(other.tile_), source_(other.source_), names_(other.names_) {}
  TilePage& operator=(const TilePage&) = delete;
  ~TilePage();

  [[nodiscard]] const TileOnDisk& tile() const { return tile_; }
  /// Of all layers together.
  [[nodiscard]] std::uint64_t cells() const { return AnyOf(tile_.cells); }
  [[nodiscard]] const PartNames& names() const { return names_; }
  /// Of a block's layer; 0 if it has none.
  [[nodiscard]] std::uint64_t PartIdOf(BlockLayer layer, int cell) const { return names_.Of(tile_.cells, layer, cell); }
  /// Whether its blocks were in memory before, so that they are read as they were: see TileSpill.
  [[nodiscard]] bool HasOwnNames() const { return !names_.AreDrawn(); }

  /// By ascending cell; reads them if nobody has. Valid as long as the page. Throws StatusError; the next call tries
  /// again.
  [[nodiscard]] std::span<const BlockEntry> blocks() const {
    if (!is_used_.load(std::memory_order_relaxed)) is_used_.store(true, std::memory_order_relaxed);
    if (IsRead()) CountHit();
    else Read();
    return blocks_;
  }
  [[nodiscard]] bool IsRead() const { return is_read_.load(std::memory_order_acquire); }
  /// Whether somebody has asked for the blocks since this was last asked.
  [[nodiscard]] bool WasUsed() const { return is_used_.exchange(false, std::memory_order_relaxed); }

  /// Another page of the same blocks: they are left on the disk again, for who has this one no longer.
  [[nodiscard]] std::shared_ptr<const TilePage> LetGo() const;

  /// Of the blocks, if they are read.
  [[nodiscard]] std::size_t BlockBytes() const { return IsRead() ? num_bytes_ : 0; }
  /// Likewise, what LabelBlock::CountedBytes counts.
  [[nodiscard]] std::size_t LabelPlaneBytes() const { return IsRead() ? num_label_plane_bytes_ : 0; }

 private:
  /// What a tile takes that is on the disk, counted as long as this lives: its page, what knows of it in a state, and
  /// its marks.
  class TableBytes {
   public:
    explicit TableBytes(std::size_t name_bytes);
    ~TableBytes();
    TableBytes(const TableBytes&) = delete;
    TableBytes& operator=(const TableBytes&) = delete;

   private:
    const std::int64_t bytes_;
  };

  /// A lookup must cost no atomic: each thread adds up many before it tells.
  static void CountHit() {
    if (++hits_of_thread_ == kHitsAtOnce) [[unlikely]]
      AddHits();
  }
  static void AddHits();
  static constexpr std::uint32_t kHitsAtOnce = 256;
  static inline constinit thread_local std::uint32_t hits_of_thread_ = 0;

  void Read() const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] Result<std::vector<BlockEntry>> ReadNamed() const;

  const TileOnDisk tile_;
  const std::shared_ptr<TileSource> source_;
  const PartNames names_;
  const TableBytes table_bytes_{names_.MemoryBytes()};
  mutable Mutex mutex_;  ///< of who reads
  mutable std::atomic<bool> is_read_ = false;
  mutable std::atomic<bool> is_used_ = false;
  // Written once, before is_read_.
  mutable std::vector<BlockEntry> blocks_;
  mutable std::size_t num_bytes_ = 0, num_label_plane_bytes_ = 0;
};

/// What pages of all maps have in memory, and what was done for it. Of the process; thread-safe.
struct PageCounts {
  std::uint64_t num_reads = 0;      ///< tiles that were read, from a store or a TileSpill
  std::uint64_t num_hits = 0;       ///< times that one was in memory already; each thread keeps up to 255 back
  std::uint64_t num_failures = 0;   ///< tiles that could not be
  std::uint64_t num_let_go = 0;     ///< tiles that were left on the disk again
  std::uint64_t num_spilled = 0;    ///< tiles that were written to a TileSpill
  std::uint64_t num_unspilled = 0;  ///< tries to write one that failed
  std::int64_t read_ns = 0;         ///< that was taken by all reads together, of threads side by side as well
  std::int64_t resident_bytes = 0;  ///< of blocks that were read and not let go of yet
  std::int64_t table_bytes = 0;     ///< of what is known of tiles that were or are on the disk, about
};
PageCounts CountPages();
/// To be called after each try to write one.
void CountSpilled(bool is_written);

}  // namespace dhpmap

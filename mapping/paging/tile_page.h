// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "mapping/voxels/block_entry.h"
#include "mapping/voxels/part_names.h"
#include "mapping/voxels/tile_loader.h"

namespace dhpmap {

/// Reads evicted blocks back, from a store. Thread-safe.
class TileSource {
 public:
  virtual ~TileSource() = default;
  /// The blocks, by ascending cell. Errors name the tile: DATA_LOSS if they are damaged or missing; ABORTED, reason
  /// SNAPSHOT_EXPIRED, if the map was opened a second time and changed since; UNAVAILABLE once the store is closed;
  /// errors of the disk.
  virtual Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) = 0;
};

/// The evicted blocks of a tile. Thread-safe.
///
/// The store keeps no blob for the sake of a page, and need not: writers read a tile before they change it, so older
/// states have it in memory before its blobs are deleted, and Map::Remove reads tiles that are not in memory. This
/// holds for states that follow one another; a state from before the map was loaded again may get ABORTED.
class TilePage final : public TileLoader {
 public:
  /// `source` is not null. `names`: of blocks that were in memory before.
  TilePage(const TileOnDisk& tile, std::shared_ptr<TileSource> source, PartNames names = PartNames::Draw())
      : TileLoader(tile, std::move(names)), source_(std::move(source)) {}
  ~TilePage() override;

  [[nodiscard]] std::shared_ptr<const TileLoader> Evicted() const override;
  [[nodiscard]] std::shared_ptr<const TileLoader> ReadInPassing() const override;
  [[nodiscard]] std::size_t OwnBytes() const override { return sizeof(*this); }

 private:
  /// Counts the memory of a tile on disk while this lives: its page, its entry in a state, and its marks.
  class TableBytes {
   public:
    explicit TableBytes(std::size_t name_bytes);
    ~TableBytes();
    TableBytes(const TableBytes&) = delete;
    TableBytes& operator=(const TableBytes&) = delete;

   private:
    const std::int64_t bytes_;
  };

  void Load() const override DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] Result<std::vector<BlockEntry>> ReadNamed() const;
  /// A new page of the same blocks and names.
  [[nodiscard]] std::shared_ptr<const TilePage> Another() const;

  const std::shared_ptr<TileSource> source_;
  const TableBytes table_bytes_{names().MemoryBytes()};
  mutable Mutex mutex_;  ///< held while reading
};

/// Memory and activity of all pages of the process; thread-safe.
struct PageCounts {
  std::uint64_t num_reads = 0;      ///< tiles that were read, from a store or a TileSpill
  std::uint64_t num_hits = 0;       ///< requests that found their blocks in memory; each thread may hold back up to 255
  std::uint64_t num_failures = 0;   ///< tiles that could not be read
  std::uint64_t num_evicted = 0;    ///< tiles that were evicted
  std::uint64_t num_spilled = 0;    ///< tiles that were written to a TileSpill
  std::uint64_t num_unspilled = 0;  ///< failed writes to a TileSpill
  std::int64_t read_ns = 0;         ///< total time of all reads, parallel ones added up
  std::int64_t resident_bytes = 0;  ///< blocks that were read and not evicted yet
  std::int64_t table_bytes = 0;     ///< metadata of tiles that are or were on disk, approximately
};
PageCounts CountPages();
/// Call after each attempt to write a tile to a TileSpill.
void CountSpilled(bool is_written);

}  // namespace dhpmap

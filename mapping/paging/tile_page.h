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

/// Where blocks are read from that were left on the disk: a store. Thread-safe.
class TileSource {
 public:
  virtual ~TileSource() = default;
  /// The blocks, by ascending cell. Errors name the tile: DATA_LOSS if they are damaged or missing; ABORTED, reason
  /// SNAPSHOT_EXPIRED, if the map, opened a second time since, was changed so that nothing needs them any more;
  /// UNAVAILABLE once the store is closed; errors of the disk.
  virtual Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) = 0;
};

/// The blocks of a tile, left on the disk until somebody reads them. Thread-safe.
///
/// A store keeps no blob for the sake of a page. It need not: who changes a tile of the newest state reads it first, so
/// what older states have of it is in memory before its blobs can go; Map::Remove reads what nobody has. That holds of
/// states that go on from one another: who has one of a map that was loaded anew since may be told ABORTED.
class TilePage final : public TileLoader {
 public:
  /// `source` is not null. `names`: of blocks that were in memory before.
  TilePage(const TileOnDisk& tile, std::shared_ptr<TileSource> source, PartNames names = PartNames::Draw())
      : TileLoader(tile, std::move(names)), source_(std::move(source)) {}
  ~TilePage() override;

  [[nodiscard]] std::shared_ptr<const TileLoader> LetGo() const override;
  [[nodiscard]] std::shared_ptr<const TileLoader> ReadInPassing() const override;
  [[nodiscard]] std::size_t OwnBytes() const override { return sizeof(*this); }

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

  void Load() const override DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] Result<std::vector<BlockEntry>> ReadNamed() const;
  /// Of the same blocks, under the same names.
  [[nodiscard]] std::shared_ptr<const TilePage> Another() const;

  const std::shared_ptr<TileSource> source_;
  const TableBytes table_bytes_{names().MemoryBytes()};
  mutable Mutex mutex_;  ///< of who reads
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
/// To be called after each try to write one to a TileSpill.
void CountSpilled(bool is_written);

}  // namespace dhpmap

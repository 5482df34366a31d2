// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

#include "mapping/voxels/block_table.h"
#include "storage/codec/bytes.h"
#include "storage/rows/kept_blobs.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// Rows of tiles, and the blobs they refer to. A blob is written once, under a key that is never given out again, and
// may be referred to by several rows. When the last one leaves it, a trigger puts it among the dead: see
// CollectDeadBlobs.

/// Whose tiles: column tiles.owner_key. Of an object its submap_key.
constexpr std::int64_t OwnerOfMap(std::int64_t map_key) { return -map_key; }

/// What a row of a tile refers to.
struct StoredBlob {
  std::int64_t key = 0;         ///< 0: there is no row
  std::int64_t num_blocks = 0;  ///< that the blob holds; 0 for layers of maps
  std::int64_t bytes = 0;
  std::uint64_t cells = 0;   ///< bit c: the blob holds the block at cell c; 0: not known, or a layer of maps
  std::uint64_t extent = 0;  ///< of a TSDF: TileExtent::Code; 0: not known, or another layer
};

inline constexpr std::size_t kNumLayerNumbers = 16;  ///< a layer's number is half a byte
/// The rows of a tile, by the number of the layer.
using StoredLayers = std::array<StoredBlob, kNumLayerNumbers>;

/// Of all rows of an owner, kept up to date with what changes. `sum` covers which rows there are and what they refer
/// to: the order of rows does not matter, so it follows a commit at the cost of what was written.
struct TileTotals {
  std::int64_t num_rows = 0;
  std::int64_t bytes = 0;
  std::int64_t sum = 0;  ///< as in columns tiles_sum, see FORMAT.md

  void Add(TileIndex index, std::int64_t layer, const StoredBlob& blob);
  void Remove(TileIndex index, std::int64_t layer, const StoredBlob& blob);
};

/// Writes rows and blobs. One for each transaction.
class TileRows {
 public:
  static Result<TileRows> Prepare(sqlite::Database& database);

  Result<StoredLayers> Find(std::int64_t owner_key, TileIndex index);
  /// Of all rows that are there: for an owner whose totals nobody has kept.
  Result<TileTotals> Count(std::int64_t owner_key);

  /// A new blob, to be referred to by one row.
  Result<StoredBlob> Insert(ByteView blob, std::int64_t num_blocks);
  /// To be called when rows of this transaction have left blobs in another way.
  void NoteDeadBlobs() { may_have_dead_ = true; }

  /// A blob that is there, to be referred to by one row more; nothing if it is there no longer.
  Result<std::optional<StoredBlob>> Share(std::int64_t blob_key);

  /// Adds rows for an owner that has none yet, which refer to the same blobs as those of another. `num_more`: how many
  /// more refer to each then; 2 for who refers to them, too.
  Status Copy(std::int64_t from_owner_key, std::int64_t to_owner_key, std::int64_t num_more = 1);
  /// Adds the row, or has it refer to another blob.
  Status Put(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
             const StoredBlob& after, TileTotals& totals);
  Status Erase(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
               TileTotals& totals);

 private:
  explicit TileRows(sqlite::Database& database) : database_(&database) {}
  using OptionalStatement = std::optional<sqlite::Statement>;
  sqlite::Database* database_;
  bool may_have_dead_ = true;  ///< some blob may be among the dead
  OptionalStatement find_, count_, insert_blob_, find_blob_, revive_, share_, copy_, share_copied_, insert_, update_,
      erase_;
};

/// Reads the rows of an owner with their blobs, by ascending tile, then layer.
class TileRowReader {
 public:
  struct Row {
    TileIndex index;
    std::int64_t layer = 0;
    std::int64_t blob_key = 0;
    std::int64_t num_blocks = 0;
    bool is_missing = false;              ///< there is no such blob
    bool is_shared = false;               ///< other rows refer to it, too
    std::uint64_t cells = 0, extent = 0;  ///< see StoredBlob
    ByteView blob;                        ///< lives as long as the visit
  };

  static Result<TileRowReader> Prepare(sqlite::Database& database);
  /// One that does not touch the blobs: whether they are missing, their number of blocks and themselves it leaves out.
  static Result<TileRowReader> PrepareWithoutBlobs(sqlite::Database& database);
  /// Likewise, for ForEachOf.
  static Result<TileRowReader> PrepareForATile(sqlite::Database& database);

  /// Calls visit(const Row&), which returns a Status; ends with the first error.
  template <typename Visitor>
  Status ForEach(std::int64_t owner_key, Visitor&& visit) {
    select_.Bind(owner_key);
    return VisitRows(visit);
  }
  /// Likewise, for the rows of one tile.
  template <typename Visitor>
  Status ForEachOf(std::int64_t owner_key, TileIndex index, Visitor&& visit) {
    select_.Bind(owner_key).Bind(index.x).Bind(index.y).Bind(index.z);
    return VisitRows(visit);
  }

 private:
  template <typename Visitor>
  Status VisitRows(Visitor& visit) {
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select_.Step());
      if (!has_row) return Status::Ok();
      Status visited = visit(Current());
      if (visited.ok()) continue;
      select_.Reset();
      return visited;
    }
  }
  explicit TileRowReader(sqlite::Statement select) : select_(std::move(select)) {}
  [[nodiscard]] Row Current() const;
  sqlite::Statement select_;
};

/// How much is collected at a time.
struct CollectBounds {
  std::int64_t max_blobs = 0;
  // One blob is collected whatever these say:
  std::int64_t max_bytes = std::numeric_limits<std::int64_t>::max();
  std::chrono::steady_clock::time_point end = std::chrono::steady_clock::time_point::max();
};
struct Collected {
  std::int64_t num_blobs = 0;
  std::int64_t num_bytes = 0;
  bool has_more = false;  ///< the bounds ended it
};
/// Deletes blobs that no row refers to any more, but none that are kept, within the caller's transaction. States in
/// memory may still name their keys: whoever wants to refer to one again asks Share first.
Result<Collected> CollectDeadBlobs(sqlite::Database& database, const CollectBounds& bounds, const KeptBlobs& kept = {});
Result<bool> HasDeadBlobs(sqlite::Database& database, const KeptBlobs& kept = {});
/// Part of each commit, within its transaction: where many are dead, as others wait for commits that follow upon each
/// other, it deletes more than it made, so that their number has a bound. `num_written`: blobs that the commit wrote.
Status CollectBacklog(sqlite::Database& database, std::int64_t num_written, const KeptBlobs& kept = {});
inline constexpr std::int64_t kMaxBacklog = 512;  ///< of dead blobs, beyond which commits help

}  // namespace dhpmap

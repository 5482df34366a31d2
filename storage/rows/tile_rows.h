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

// Rows of tiles, and their blobs. A blob is immutable, under a key that is never reused, and several rows may refer to
// it. When the last reference goes, a trigger lists it as dead: see CollectDeadBlobs.

/// Column tiles.owner_key; for an object it is the submap_key.
constexpr std::int64_t OwnerOfMap(std::int64_t map_key) { return -map_key; }

/// The blob of a tile's row.
struct StoredBlob {
  std::int64_t key = 0;         ///< 0: there is no row
  std::int64_t num_blocks = 0;  ///< in the blob; 0 for layers of maps
  std::int64_t bytes = 0;
  std::uint64_t cells = 0;   ///< bit c: the blob has a block at cell c; 0: unknown, or a layer of maps
  std::uint64_t extent = 0;  ///< of a TSDF: TileExtent::Code; 0: unknown, or another layer
};

inline constexpr std::size_t kNumLayerNumbers = 16;  ///< a layer's number is half a byte
/// The rows of a tile, by the number of the layer.
using StoredLayers = std::array<StoredBlob, kNumLayerNumbers>;

/// Totals of all rows of an owner, updated incrementally. `sum` covers the set of rows and their references,
/// independent of their order, so a commit updates it in time linear in its writes.
struct TileTotals {
  std::int64_t num_rows = 0;
  std::int64_t bytes = 0;
  std::int64_t sum = 0;  ///< as columns tiles_sum, see FORMAT.md

  void Add(TileIndex index, std::int64_t layer, const StoredBlob& blob);
  void Remove(TileIndex index, std::int64_t layer, const StoredBlob& blob);
};

/// Writes rows and blobs. One for each transaction.
class TileRows {
 public:
  static Result<TileRows> Prepare(sqlite::Database& database);

  Result<StoredLayers> Find(std::int64_t owner_key, TileIndex index);
  /// Recomputes the totals from all rows, for an owner without stored ones.
  Result<TileTotals> Count(std::int64_t owner_key);

  /// Writes a new blob, for one row.
  Result<StoredBlob> Insert(ByteView blob, std::int64_t num_blocks);
  /// Call if other statements of this transaction released blobs.
  void NoteDeadBlobs() { may_have_dead_ = true; }

  /// Adds a reference to an existing blob; nothing if it is gone.
  Result<std::optional<StoredBlob>> Share(std::int64_t blob_key);

  /// Adds rows for a new owner that refer to the blobs of another. `num_more`: references added to each; 2 if the
  /// edit's undo data refer to them, too.
  Status Copy(std::int64_t from_owner_key, std::int64_t to_owner_key, std::int64_t num_more = 1);
  /// Adds the row, or changes its blob.
  Status Put(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
             const StoredBlob& after, TileTotals& totals);
  Status Erase(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
               TileTotals& totals);

 private:
  explicit TileRows(sqlite::Database& database) : database_(&database) {}
  using OptionalStatement = std::optional<sqlite::Statement>;
  sqlite::Database* database_;
  bool may_have_dead_ = true;  ///< there may be dead blobs
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
    ByteView blob;                        ///< valid during the visit
  };

  static Result<TileRowReader> Prepare(sqlite::Database& database);
  /// Without reading blobs: leaves out is_missing, num_blocks and blob.
  static Result<TileRowReader> PrepareWithoutBlobs(sqlite::Database& database);
  /// Likewise, for ForEachOf.
  static Result<TileRowReader> PrepareForATile(sqlite::Database& database);

  /// Calls visit(const Row&), which returns a Status; stops at the first error.
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

/// Limits of one collection.
struct CollectBounds {
  std::int64_t max_blobs = 0;
  // At least one blob is collected:
  std::int64_t max_bytes = std::numeric_limits<std::int64_t>::max();
  std::chrono::steady_clock::time_point end = std::chrono::steady_clock::time_point::max();
};
struct Collected {
  std::int64_t num_blobs = 0;
  std::int64_t num_bytes = 0;
  bool has_more = false;  ///< stopped by the limits
};
/// Deletes unreferenced blobs, except protected ones, within the caller's transaction. States in memory may still have
/// their keys: use Share before referring to one again.
Result<Collected> CollectDeadBlobs(sqlite::Database& database, const CollectBounds& bounds, const KeptBlobs& kept = {});
Result<bool> HasDeadBlobs(sqlite::Database& database, const KeptBlobs& kept = {});
/// Part of each commit: if many blobs are dead, it deletes more than it wrote, so that their number stays bounded even
/// under continuous commits. `num_written`: blobs that the commit wrote.
Status CollectBacklog(sqlite::Database& database, std::int64_t num_written, const KeptBlobs& kept = {});
inline constexpr std::int64_t kMaxBacklog = 512;  ///< number of dead blobs beyond which commits help

}  // namespace dhpmap

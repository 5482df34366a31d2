// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>

#include "mapping/voxels/block_table.h"
#include "storage/codec/bytes.h"
#include "storage/commit/state_tables.h"
#include "storage/rows/kept_blobs.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

// Rows of tiles, and their blobs. A blob is immutable, under a key that is never reused, and several rows may refer to
// it. When the last reference goes, a trigger lists it as dead: see CollectDeadBlobs.

/// Column tiles.owner_key; for an object it is the submap_key.
constexpr std::int64_t OwnerOfMap(std::int64_t map_key) { return -map_key; }

/// Writes rows and blobs. One for each transaction.
class TileRows final : public TileTable {
 public:
  static Result<TileRows> Prepare(sqlite::Database& database);

  Result<StoredLayers> Find(std::int64_t owner_key, TileIndex index) override;
  Result<TileTotals> Count(std::int64_t owner_key) override;
  Result<StoredBlob> Insert(ByteView blob, std::int64_t num_blocks) override;
  void NoteDeadBlobs() override { may_have_dead_ = true; }
  Result<std::optional<StoredBlob>> Share(std::int64_t blob_key) override;
  Status Copy(std::int64_t from_owner_key, std::int64_t to_owner_key, std::int64_t num_more) override;
  Status Put(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
             const StoredBlob& after, TileTotals& totals) override;
  Status Erase(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
               TileTotals& totals) override;

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
  using Row = TileRow;

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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "storage/commit/state_tables.h"
#include "storage/postgres/answer.h"
#include "storage/postgres/commit/commit_places.h"
#include "storage/postgres/values.h"
#include "storage/rows/submap_rows.h"

namespace dhpmap::postgres {

/// Column tiles.owner_id of what belongs to the map itself; of a submap it is the id.
inline constexpr std::int64_t kMapsOwner = -1;

/// How many more refer to each blob after a commit.
class BlobCounts {
 public:
  void Add(std::int64_t blob_key, std::int64_t num) {
    if (blob_key != 0) changes_[blob_key] += num;
  }
  /// `now_ns`: since when who has no reference left has none.
  void Write(std::int64_t map_key, std::int64_t now_ns, std::vector<Call>& calls) const;

 private:
  std::map<std::int64_t, std::int64_t> changes_;
};

/// Tiles and submaps of a map during a commit: what was fetched of them, and what is to be written. Asked for a row
/// that was not fetched it answers as if there were none, so all that a commit may ask for must have been.
class TileWrites final : public TileTable {
 public:
  explicit TileWrites(std::int64_t next_blob_key) : next_blob_key_(next_blob_key) {}

  // Rows that were fetched: see kTileColumns, and blob_key, num_blocks, bytes.
  void Fetched(Answer& tiles);
  void FetchedBlobs(Answer& blobs);

  Result<StoredLayers> Find(std::int64_t owner_key, TileIndex index) override;
  Result<TileTotals> Count(std::int64_t owner_key) override;
  Result<StoredBlob> Insert(ByteView blob, std::int64_t num_blocks) override;
  void NoteDeadBlobs() override {}
  Result<std::optional<StoredBlob>> Share(std::int64_t blob_key) override;
  Status Copy(std::int64_t from_owner_key, std::int64_t to_owner_key, std::int64_t num_more) override;
  Status Put(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
             const StoredBlob& after, TileTotals& totals) override;
  Status Erase(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
               TileTotals& totals) override;
  /// All rows of an owner.
  void EraseAll(std::int64_t owner_key);

  struct Row {
    TileIndex index;
    std::int64_t layer = 0;
    std::int64_t blob_key = 0;
  };
  /// As they are now.
  [[nodiscard]] std::vector<Row> RowsOf(std::int64_t owner_key) const;

  BlobCounts& counts() { return counts_; }
  [[nodiscard]] std::int64_t next_blob_key() const { return next_blob_key_; }
  [[nodiscard]] std::int64_t num_blobs() const { return static_cast<std::int64_t>(blob_calls_.size()); }

  /// Adds the statements that write it all.
  void Write(std::int64_t map_key, std::int64_t now_ns, std::vector<Call>& calls);
  /// Adds the rows that these statements write or erase.
  void AddTo(CommitPlaces& places) const;

 private:
  struct Place {
    std::int64_t owner = 0;
    std::int32_t x = 0, y = 0, z = 0;
    std::int64_t layer = 0;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  struct Tile {
    StoredBlob blob;         ///< key 0: there is no row
    bool is_stored = false;  ///< there was one before
    bool is_changed = false;
    [[nodiscard]] bool IsToBeWritten() const { return is_changed && (blob.key != 0 || is_stored); }
  };
  using Tiles = std::map<Place, Tile>;
  static Place PlaceOf(std::int64_t owner, TileIndex index, std::int64_t layer) {
    return {owner, index.x, index.y, index.z, layer};
  }
  [[nodiscard]] Tiles::const_iterator FirstOf(std::int64_t owner) const;
  void Set(std::int64_t owner, TileIndex index, std::int64_t layer, const StoredBlob& blob);

  std::int64_t next_blob_key_;
  Tiles tiles_;
  std::map<std::int64_t, StoredBlob> blobs_;  ///< those that may be shared
  std::vector<Call> blob_calls_;              ///< without the map's key
  std::vector<std::int64_t> erased_owners_;
  BlobCounts counts_;
};

/// The submaps' rows during a commit.
class SubmapWrites final : public SubmapTable {
 public:
  /// `tiles` outlives it.
  explicit SubmapWrites(TileWrites& tiles) : tiles_(tiles) {}

  void Fetched(Answer& submaps);
  Result<std::optional<Stored>> Find(std::int64_t map_key, SubmapId id) override;
  Result<std::int64_t> Write(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts,
                             std::int64_t tiles_sum) override;
  Status Erase(std::int64_t submap_key) override;

  void Write(std::int64_t map_key, std::vector<Call>& calls) const;
  /// As TileWrites::AddTo.
  void AddTo(CommitPlaces& places) const;

 private:
  TileWrites& tiles_;
  std::map<std::int64_t, SubmapRow> stored_, written_;
  std::vector<std::int64_t> erased_;
};

/// SELECT of the columns that TileWrites::Fetched reads: of tiles named by four arrays ($2 to $5), and of all tiles of
/// owners ($2).
const std::string& TilesByPlace();
const std::string& TilesByOwner();
/// Of submaps by id ($2), and of blobs by key ($2).
const std::string& SubmapsById();
const std::string& BlobsByKey();

}  // namespace dhpmap::postgres

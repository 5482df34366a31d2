// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "storage/commit/state_tables.h"
#include "storage/postgres/answer.h"
#include "storage/postgres/tiles/blob_counts.h"
#include "storage/postgres/tiles/commit_places.h"
#include "storage/postgres/values.h"

namespace dhpmap::postgres {

/// The tile rows of a map during a commit: those fetched and those to write. A row that was not fetched counts as
/// absent, so fetch every row that the commit may ask for.
class TileWrites final : public TileTable {
 public:
  explicit TileWrites(std::int64_t next_blob_key) : next_blob_key_(next_blob_key) {}

  // Fetched rows: kTileColumns; blob_key, num_blocks, bytes.
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
  /// Erases all rows of an owner.
  void EraseAll(std::int64_t owner_key);

  struct Row {
    TileIndex index;
    std::int64_t layer = 0;
    std::int64_t blob_key = 0;
  };
  /// The present totals.
  [[nodiscard]] std::vector<Row> RowsOf(std::int64_t owner_key) const;

  BlobCounts& counts() { return counts_; }
  [[nodiscard]] std::int64_t next_blob_key() const { return next_blob_key_; }
  [[nodiscard]] std::int64_t num_blobs() const { return static_cast<std::int64_t>(blob_calls_.size()); }

  /// Adds the statements that write all changes.
  void Write(std::int64_t map_key, std::int64_t now_ns, std::vector<Call>& calls);
  /// Adds the places of the rows that these statements write or erase.
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

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/tile_rows.h"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

using sqlite::Columns;
using sqlite::Database;
using sqlite::Statement;

constexpr char kReadTilesTask[] = "read the tiles";
constexpr char kWriteTileTask[] = "write a tile";
constexpr char kCollectTask[] = "collect what is no longer needed";

TileIndex TileIndexFrom(Columns& columns) {
  TileIndex index;
  for (std::int32_t* coordinate : {&index.x, &index.y, &index.z})
    *coordinate = static_cast<std::int32_t>(columns.Int());
  return index;
}

Statement& BindIndex(Statement& statement, TileIndex index) {
  return statement.Bind(index.x).Bind(index.y).Bind(index.z);
}

}  // namespace

Result<TileRows> TileRows::Prepare(Database& database) {
  TileRows rows(database);
  struct Text {
    OptionalStatement* statement;
    const char* sql;
  };
  const std::initializer_list<Text> texts = {
      {&rows.find_,
       "SELECT layer, blob_key, ifnull(num_blocks, 0), ifnull(length(blob), 0) FROM tiles LEFT JOIN tile_blobs "
       "USING (blob_key) WHERE owner_key = ? AND x = ? AND y = ? AND z = ?"},
      {&rows.count_,
       "SELECT x, y, z, layer, blob_key, ifnull(length(blob), 0) FROM tiles LEFT JOIN tile_blobs USING (blob_key) "
       "WHERE owner_key = ?"},
      {&rows.insert_blob_, "INSERT INTO tile_blobs (num_blocks, blob) VALUES (?, ?)"},
      {&rows.find_blob_, "SELECT num_blocks, length(blob) FROM tile_blobs WHERE blob_key = ?"},
      {&rows.revive_, "DELETE FROM dead_blobs WHERE blob_key = ?"},
      {&rows.share_,
       "INSERT INTO shared_blobs (blob_key, num_more) VALUES (?, 1) ON CONFLICT (blob_key) DO UPDATE SET num_more = "
       "num_more + 1"},
      {&rows.copy_,
       "INSERT INTO tiles (owner_key, x, y, z, layer, blob_key, cells, extent) SELECT ?, x, y, z, layer, blob_key, "
       "cells, extent FROM tiles WHERE owner_key = ?"},
      {&rows.share_copied_,
       "INSERT INTO shared_blobs (blob_key, num_more) SELECT blob_key, ?1 FROM tiles WHERE owner_key = ?2 ON CONFLICT "
       "(blob_key) DO UPDATE SET num_more = num_more + ?1"},
      {&rows.insert_,
       "INSERT INTO tiles (owner_key, x, y, z, layer, blob_key, cells, extent) VALUES (?, ?, ?, ?, ?, ?, ?, ?)"},
      {&rows.update_,
       "UPDATE tiles SET blob_key = ?, cells = ?, extent = ? WHERE owner_key = ? AND x = ? AND y = ? AND z = ? AND "
       "layer = ?"},
      {&rows.erase_, "DELETE FROM tiles WHERE owner_key = ? AND x = ? AND y = ? AND z = ? AND layer = ?"},
  };
  for (const Text& text : texts) {
    DHPMAP_ASSIGN_OR_RETURN(Statement statement, database.Prepare(text.sql, kWriteTileTask));
    text.statement->emplace(std::move(statement));
  }
  DHPMAP_ASSIGN_OR_RETURN(rows.may_have_dead_, HasDeadBlobs(database));
  return rows;
}

Result<StoredLayers> TileRows::Find(std::int64_t owner_key, TileIndex index) {
  StoredLayers layers{};
  BindIndex(find_->Bind(owner_key), index);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, find_->Step());
    if (!has_row) return layers;
    Columns columns(*find_);
    const auto layer = static_cast<std::uint64_t>(columns.Int());
    if (layer >= layers.size()) continue;  // unknown layer: reported when the map is read
    layers[layer].key = columns.Int();
    layers[layer].num_blocks = columns.Int();
    layers[layer].bytes = columns.Int();
  }
}

Result<TileTotals> TileRows::Count(std::int64_t owner_key) {
  TileTotals totals;
  count_->Bind(owner_key);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, count_->Step());
    if (!has_row) return totals;
    Columns columns(*count_);
    const TileIndex index = TileIndexFrom(columns);
    const std::int64_t layer = columns.Int();
    StoredBlob blob;
    blob.key = columns.Int();
    blob.bytes = columns.Int();
    totals.Add(index, layer, blob);
  }
}

Result<StoredBlob> TileRows::Insert(ByteView blob, std::int64_t num_blocks) {
  DHPMAP_RETURN_IF_ERROR(insert_blob_->Bind(num_blocks).Bind(blob).Run());
  return StoredBlob{
      .key = database_->LastInsertRowId(), .num_blocks = num_blocks, .bytes = static_cast<std::int64_t>(blob.size())};
}

Result<std::optional<StoredBlob>> TileRows::Share(std::int64_t blob_key) {
  DHPMAP_ASSIGN_OR_RETURN(const bool is_there, find_blob_->Bind(blob_key).Step());
  if (!is_there) return std::optional<StoredBlob>();
  Columns columns(*find_blob_);
  StoredBlob blob{.key = blob_key};
  blob.num_blocks = columns.Int();
  blob.bytes = columns.Int();
  find_blob_->Reset();
  if (may_have_dead_) {
    DHPMAP_RETURN_IF_ERROR(revive_->Bind(blob_key).Run());
    if (database_->NumChanges() > 0) return std::optional<StoredBlob>(blob);  // it has no other references
  }
  DHPMAP_RETURN_IF_ERROR(share_->Bind(blob_key).Run());
  return std::optional<StoredBlob>(blob);
}

Status TileRows::Copy(std::int64_t from_owner_key, std::int64_t to_owner_key, std::int64_t num_more) {
  DHPMAP_RETURN_IF_ERROR(copy_->Bind(to_owner_key).Bind(from_owner_key).Run());
  return share_copied_->Bind(num_more).Bind(to_owner_key).Run();
}

Status TileRows::Put(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
                     const StoredBlob& after, TileTotals& totals) {
  totals.Add(index, layer, after);
  const auto cells = static_cast<std::int64_t>(after.cells), extent = static_cast<std::int64_t>(after.extent);
  if (before.key == 0) {
    return BindIndex(insert_->Bind(owner_key), index).Bind(layer).Bind(after.key).Bind(cells).Bind(extent).Run();
  }
  totals.Remove(index, layer, before);
  may_have_dead_ = true;
  return BindIndex(update_->Bind(after.key).Bind(cells).Bind(extent).Bind(owner_key), index).Bind(layer).Run();
}

Status TileRows::Erase(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
                       TileTotals& totals) {
  if (before.key == 0) return Status::Ok();
  totals.Remove(index, layer, before);
  may_have_dead_ = true;
  return BindIndex(erase_->Bind(owner_key), index).Bind(layer).Run();
}

Result<TileRowReader> TileRowReader::Prepare(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT x, y, z, layer, tiles.blob_key, tile_blobs.blob_key IS NULL, num_more IS NOT NULL, "
                       "ifnull(num_blocks, 0), cells, extent, blob "
                       "FROM tiles LEFT JOIN tile_blobs USING (blob_key) LEFT JOIN shared_blobs USING (blob_key) "
                       "WHERE owner_key = ? ORDER BY owner_key, x, y, z, layer",
                       kReadTilesTask));
  return TileRowReader(std::move(select));
}

namespace {

Result<Statement> SelectWithoutBlobs(Database& database, const std::string& of_which) {
  return database.Prepare(
      "SELECT x, y, z, layer, tiles.blob_key, 0, num_more IS NOT NULL, 0, cells, extent, x'' FROM tiles LEFT "
      "JOIN shared_blobs USING (blob_key) WHERE " +
          of_which + " ORDER BY owner_key, x, y, z, layer",
      kReadTilesTask);
}

}  // namespace

Result<TileRowReader> TileRowReader::PrepareWithoutBlobs(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, SelectWithoutBlobs(database, "owner_key = ?"));
  return TileRowReader(std::move(select));
}

Result<TileRowReader> TileRowReader::PrepareForATile(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select,
                          SelectWithoutBlobs(database, "owner_key = ? AND x = ? AND y = ? AND z = ?"));
  return TileRowReader(std::move(select));
}

TileRowReader::Row TileRowReader::Current() const {
  Columns columns(select_);
  Row row;
  row.index = TileIndexFrom(columns);
  row.layer = columns.Int();
  row.blob_key = columns.Int();
  row.is_missing = columns.Int() != 0;
  row.is_shared = columns.Int() != 0;
  row.num_blocks = columns.Int();
  row.cells = static_cast<std::uint64_t>(columns.Int());
  row.extent = static_cast<std::uint64_t>(columns.Int());
  row.blob = columns.Blob();
  return row;
}

namespace {

/// A blob without references.
struct DeadBlob {
  std::int64_t key = 0;
  std::int64_t bytes = 0;
};

/// Collects dead blobs one by one, so that it can stop after any of them.
class DeadBlobCollector {
 public:
  static Result<DeadBlobCollector> Prepare(Database& database, const CollectBounds& bounds) {
    // Sizes are in the row header, so the blobs themselves are not read.
    DHPMAP_ASSIGN_OR_RETURN(
        Statement find,
        database.Prepare("SELECT blob_key, ifnull(length(blob), 0) FROM dead_blobs LEFT JOIN tile_blobs "
                         "USING (blob_key) WHERE blob_key BETWEEN ? AND ? ORDER BY blob_key LIMIT ?",
                         kCollectTask));
    DHPMAP_ASSIGN_OR_RETURN(Statement erase_blob,
                            database.Prepare("DELETE FROM tile_blobs WHERE blob_key = ?", kCollectTask));
    DHPMAP_ASSIGN_OR_RETURN(Statement erase_dead,
                            database.Prepare("DELETE FROM dead_blobs WHERE blob_key = ?", kCollectTask));
    return DeadBlobCollector(std::move(find), std::move(erase_blob), std::move(erase_dead), bounds);
  }

  Status CollectIn(BlobRange range) {
    while (!collected_.has_more) {
      DHPMAP_RETURN_IF_ERROR(Find(range));
      if (found_.empty()) return Status::Ok();
      for (const DeadBlob& dead : found_) {
        collected_.has_more = IsEnough(dead);
        if (collected_.has_more) return Status::Ok();
        DHPMAP_RETURN_IF_ERROR(erase_blob_.Bind(dead.key).Run());
        DHPMAP_RETURN_IF_ERROR(erase_dead_.Bind(dead.key).Run());
        ++collected_.num_blobs;
        collected_.num_bytes += dead.bytes;
      }
      range.first = found_.back().key + 1;
    }
    return Status::Ok();
  }
  [[nodiscard]] const Collected& collected() const { return collected_; }

 private:
  DeadBlobCollector(Statement find, Statement erase_blob, Statement erase_dead, const CollectBounds& bounds)
      : find_(std::move(find)),
        erase_blob_(std::move(erase_blob)),
        erase_dead_(std::move(erase_dead)),
        bounds_(bounds) {}

  /// Finds the next blobs of a range by seeking, so skipped ranges cost nothing.
  Status Find(const BlobRange& range) {
    constexpr std::int64_t kAtATime = 32;
    found_.clear();
    find_.Bind(range.first).Bind(range.last).Bind(kAtATime);
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, find_.Step());
      if (!has_row) return Status::Ok();
      found_.push_back({find_.Int(0), find_.Int(1)});
    }
  }
  [[nodiscard]] bool IsEnough(const DeadBlob& next) const {
    if (collected_.num_blobs >= bounds_.max_blobs) return true;
    if (collected_.num_blobs == 0) return false;
    return collected_.num_bytes + next.bytes > bounds_.max_bytes || std::chrono::steady_clock::now() >= bounds_.end;
  }

  Statement find_, erase_blob_, erase_dead_;
  const CollectBounds bounds_;
  std::vector<DeadBlob> found_;
  Collected collected_;
};

}  // namespace

Result<Collected> CollectDeadBlobs(Database& database, const CollectBounds& bounds, const KeptBlobs& kept) {
  DHPMAP_ASSIGN_OR_RETURN(DeadBlobCollector collector, DeadBlobCollector::Prepare(database, bounds));
  for (const BlobRange& range : kept.Others()) DHPMAP_RETURN_IF_ERROR(collector.CollectIn(range));
  return collector.collected();
}

Result<bool> HasDeadBlobs(Database& database, const KeptBlobs& kept) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT EXISTS (SELECT 1 FROM dead_blobs WHERE blob_key BETWEEN ? AND ?)", kCollectTask));
  for (const BlobRange& range : kept.Others()) {
    DHPMAP_RETURN_IF_ERROR(select.Bind(range.first).Bind(range.last).Step().status());
    if (select.Int(0) != 0) return true;
    select.Reset();
  }
  return false;
}

Status CollectBacklog(Database& database, std::int64_t num_written, const KeptBlobs& kept) {
  DHPMAP_ASSIGN_OR_RETURN(
      const std::int64_t is_large,
      database.QueryInt("SELECT EXISTS (SELECT 1 FROM dead_blobs LIMIT 1 OFFSET " + std::to_string(kMaxBacklog) + ")",
                        kCollectTask));
  constexpr std::int64_t kFactor = 2;
  return is_large == 0 ? Status::Ok() : CollectDeadBlobs(database, {.max_blobs = kFactor * num_written}, kept).status();
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/schema/bundle_blocks.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "storage/codec/block_bundle.h"

namespace dhpmap {
namespace {

using sqlite::Columns;
using sqlite::Database;
using sqlite::Statement;

constexpr char kBundleTask[] = "bring the blocks up to date";

/// A table of blocks, and the layer that it is converted to.
struct OldBlockTable {
  const char* name;
  std::int64_t layer;
  BlobKind bundle;
};
constexpr OldBlockTable kBlockTables[] = {{"tsdf_blocks", 1, BlobKind::kTsdfBlocks},
                                          {"label_blocks", 2, BlobKind::kLabelsBlocks},
                                          {"gone_blocks", 4, BlobKind::kGoneBlocks}};

struct BlockRow {
  std::int64_t key = 0;
  int cell = 0;
};
using RowsByTile = std::map<TileIndex, std::vector<BlockRow>>;

BlockIndex BlockIndexFrom(Columns& columns) {
  BlockIndex index;
  for (std::int32_t* coordinate : {&index.x, &index.y, &index.z})
    *coordinate = static_cast<std::int32_t>(columns.Int());
  return index;
}

/// Inserts blobs without decoding them.
class TileInserter {
 public:
  static Result<TileInserter> Prepare(Database& database) {
    DHPMAP_ASSIGN_OR_RETURN(Statement blob,
                            database.Prepare("INSERT INTO tile_blobs (num_blocks, blob) VALUES (?, ?)", kBundleTask));
    DHPMAP_ASSIGN_OR_RETURN(
        Statement tile,
        database.Prepare("INSERT INTO tiles (owner_key, x, y, z, layer, blob_key) VALUES (?, ?, ?, ?, ?, ?)",
                         kBundleTask));
    return TileInserter(database, std::move(blob), std::move(tile));
  }

  Status Insert(std::int64_t owner_key, TileIndex index, std::int64_t layer, ByteView blob, std::int64_t num_blocks) {
    DHPMAP_RETURN_IF_ERROR(blob_.Bind(num_blocks).Bind(blob).Run());
    return tile_.Bind(owner_key)
        .Bind(index.x)
        .Bind(index.y)
        .Bind(index.z)
        .Bind(layer)
        .Bind(database_->LastInsertRowId())
        .Run();
  }

 private:
  TileInserter(Database& database, Statement blob, Statement tile)
      : database_(&database), blob_(std::move(blob)), tile_(std::move(tile)) {}
  Database* database_;
  Statement blob_, tile_;
};

Result<RowsByTile> ListBlocks(Database& database, const OldBlockTable& table, std::int64_t submap_key) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare(std::string("SELECT x, y, z, block_key FROM ") +
                                                                 table.name + " WHERE submap_key = ?",
                                                             kBundleTask));
  select.Bind(submap_key);
  RowsByTile rows;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) break;
    Columns columns(select);
    const BlockIndex index = BlockIndexFrom(columns);
    rows[TileOf(index)].push_back({.key = columns.Int(), .cell = CellOf(index)});
  }
  for (auto& [index, blocks] : rows) {
    std::sort(blocks.begin(), blocks.end(), [](const BlockRow& a, const BlockRow& b) { return a.cell < b.cell; });
  }
  return rows;
}

/// Moves the rows of a tile out of their table.
Result<std::vector<BundledBlob>> TakeBlobs(const std::vector<BlockRow>& blocks, Statement& read, Statement& erase) {
  std::vector<BundledBlob> blobs;
  for (const BlockRow& block : blocks) {
    DHPMAP_ASSIGN_OR_RETURN(const bool is_there, read.Bind(block.key).Step());
    if (!is_there) return Internal("a block that was listed is not there");
    const ByteView blob = read.Blob(0);
    blobs.push_back({block.cell, Bytes(blob.begin(), blob.end())});
    read.Reset();
    DHPMAP_RETURN_IF_ERROR(erase.Bind(block.key).Run());
  }
  return blobs;
}

/// Bundles a layer of a submap, at most `num_left` tiles, which it decrements.
Status BundleLayer(Database& database, const OldBlockTable& table, std::int64_t submap_key, TileInserter& tiles,
                   std::int64_t& num_left) {
  if (num_left == 0) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(const RowsByTile rows, ListBlocks(database, table, submap_key));
  const std::string of_block = std::string(table.name) + " WHERE block_key = ?";
  DHPMAP_ASSIGN_OR_RETURN(Statement read, database.Prepare("SELECT blob FROM " + of_block, kBundleTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase, database.Prepare("DELETE FROM " + of_block, kBundleTask));
  for (const auto& [index, blocks] : rows) {
    if (num_left == 0) break;
    --num_left;
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<BundledBlob> blobs, TakeBlobs(blocks, read, erase));
    DHPMAP_RETURN_IF_ERROR(tiles.Insert(submap_key, index, table.layer, EncodeBundle(table.bundle, blobs, index),
                                        static_cast<std::int64_t>(blobs.size())));
  }
  return Status::Ok();
}

Status SumBytes(Database& database, std::int64_t submap_key) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement update,
      database.Prepare("UPDATE submaps SET blob_bytes = (SELECT ifnull(sum(length(blob)), 0) FROM tiles JOIN "
                       "tile_blobs USING (blob_key) WHERE owner_key = submap_key) WHERE submap_key = ?",
                       kBundleTask));
  return update.Bind(submap_key).Run();
}

/// Layers of maps are tiles already, and are moved.
Status MoveMapTiles(Database& database, TileInserter& tiles, std::int64_t& num_left) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT x, y, z, tile_key, map_key, layer, blob FROM map_tiles ORDER BY tile_key LIMIT ?",
                       kBundleTask));
  std::int64_t last_key = 0;
  select.Bind(num_left);
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) break;
    Columns columns(select);
    const BlockIndex index = BlockIndexFrom(columns);
    last_key = columns.Int();
    const std::int64_t map_key = columns.Int(), layer = columns.Int();
    DHPMAP_RETURN_IF_ERROR(tiles.Insert(-map_key, {index.x, index.y, index.z}, layer, columns.Blob(), 0));
    --num_left;
  }
  return database.Execute("DELETE FROM map_tiles WHERE tile_key <= " + std::to_string(last_key), kBundleTask);
}

Result<std::vector<std::int64_t>> SubmapsLeft(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT submap_key FROM submaps s WHERE "
                       "EXISTS (SELECT 1 FROM tsdf_blocks b WHERE b.submap_key = s.submap_key) OR "
                       "EXISTS (SELECT 1 FROM label_blocks b WHERE b.submap_key = s.submap_key) OR "
                       "EXISTS (SELECT 1 FROM gone_blocks b WHERE b.submap_key = s.submap_key) ORDER BY submap_key",
                       kBundleTask));
  std::vector<std::int64_t> keys;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return keys;
    keys.push_back(select.Int(0));
  }
}

Result<bool> HasOldTables(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(
      const std::int64_t num_tables,
      database.QueryInt("SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name = 'tsdf_blocks'",
                        kBundleTask));
  return num_tables > 0;
}

Result<std::int64_t> BundleSome(Database& database, std::int64_t max_tiles) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<std::int64_t> submaps, SubmapsLeft(database));
  DHPMAP_ASSIGN_OR_RETURN(TileInserter tiles, TileInserter::Prepare(database));
  std::int64_t num_left = max_tiles, num_done = 0;
  for (const std::int64_t submap_key : submaps) {
    if (num_left == 0) break;
    for (const OldBlockTable& table : kBlockTables) {
      DHPMAP_RETURN_IF_ERROR(BundleLayer(database, table, submap_key, tiles, num_left));
    }
    DHPMAP_RETURN_IF_ERROR(SumBytes(database, submap_key));
    if (num_left > 0) ++num_done;
  }
  if (num_left > 0) DHPMAP_RETURN_IF_ERROR(MoveMapTiles(database, tiles, num_left));
  return static_cast<std::int64_t>(submaps.size()) - num_done + (num_left == 0 ? 1 : 0);
}

Status DropOldTables(Database& database) {
  return database.Execute(
      "DROP TABLE tsdf_blocks; DROP TABLE label_blocks; DROP TABLE gone_blocks; DROP TABLE map_tiles", kBundleTask);
}

/// One transaction. Returns the number of submaps left, plus one while any work is left.
Result<std::int64_t> DoSome(Database& database, std::int64_t max_tiles) {
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t num_left, BundleSome(database, max_tiles));
  if (num_left == 0) DHPMAP_RETURN_IF_ERROR(DropOldTables(database));
  return num_left;
}

}  // namespace

const SchemaWork kBundleBlocks = {.is_left = HasOldTables, .do_some = DoSome, .unit = "submaps"};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/paging/tile_cells.h"

#include <limits>
#include <vector>

#include "storage/rows/map_rows.h"
#include "storage/rows/submap_rows.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap {
namespace {

using sqlite::Columns;
using sqlite::Database;
using sqlite::Statement;

constexpr char kCellsTask[] = "note which blocks tiles have";
constexpr std::int64_t kRowsATime = 256;

/// A row of an owner whose cells were not recorded.
struct RowPlace {
  TileIndex index;
  std::int64_t layer = -1;  ///< before all layers of the tile
  // To be recorded:
  std::uint64_t cells = 0, extent = 0;
};

/// Determines the cells from the blob.
Status Look(ByteView blob, RowPlace& row) {
  const ObjectLayer* layer = FindObjectLayer(row.layer);
  if (layer == nullptr) return FailedPrecondition("a tile is of a layer unknown to this version");
  BlockTile tile;
  DHPMAP_RETURN_IF_ERROR(layer->decode(blob, row.index, tile));
  row.cells = tile.cells();
  if (layer->layer == BlockLayer::kTsdf) row.extent = tile.Extent().Code();
  return Status::Ok();
}

/// The next rows after `last`, which is advanced to the last of them.
Result<std::vector<RowPlace>> NextRows(Database& database, std::int64_t owner_key, RowPlace& last) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare(
          "SELECT x, y, z, layer, blob FROM tiles JOIN tile_blobs USING (blob_key) WHERE owner_key = ? AND "
          "(x, y, z, layer) > (?, ?, ?, ?) AND cells = 0 ORDER BY x, y, z, layer LIMIT ?",
          kCellsTask));
  select.Bind(owner_key).Bind(last.index.x).Bind(last.index.y).Bind(last.index.z).Bind(last.layer).Bind(kRowsATime);
  std::vector<RowPlace> rows;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) break;
    Columns columns(select);
    RowPlace& row = rows.emplace_back();
    for (std::int32_t* axis : {&row.index.x, &row.index.y, &row.index.z}) {
      *axis = static_cast<std::int32_t>(columns.Int());
    }
    row.layer = columns.Int();
    DHPMAP_RETURN_IF_ERROR(Look(columns.Blob(), row));
  }
  if (!rows.empty()) last = rows.back();
  return rows;
}

/// Records the cells of some rows. Returns whether there were any.
Result<bool> NoteSome(Database& database, std::int64_t owner_key, RowPlace& last) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<RowPlace> rows, NextRows(database, owner_key, last));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement update,
      database.Prepare(
          "UPDATE tiles SET cells = ?, extent = ? WHERE owner_key = ? AND x = ? AND y = ? AND z = ? AND layer = ?",
          kCellsTask));
  for (const RowPlace& row : rows) {
    update.Bind(static_cast<std::int64_t>(row.cells)).Bind(static_cast<std::int64_t>(row.extent)).Bind(owner_key);
    DHPMAP_RETURN_IF_ERROR(update.Bind(row.index.x).Bind(row.index.y).Bind(row.index.z).Bind(row.layer).Run());
  }
  return !rows.empty();
}

}  // namespace

Result<std::vector<std::int64_t>> OwnersWithoutCells(Database& database, std::int64_t map_key) {
  // The index tiles_without_cells contains only such rows, and none for maps written by this version.
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT DISTINCT owner_key FROM tiles INDEXED BY tiles_without_cells JOIN submaps ON submap_key "
                       "= owner_key WHERE cells = 0 AND owner_key > 0 AND map_key = ? ORDER BY owner_key",
                       kCellsTask));
  select.Bind(map_key);
  std::vector<std::int64_t> owners;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return owners;
    owners.push_back(select.Int(0));
  }
}

Status NoteTileCells(const WriteRows& write, const std::string& map) {
  std::vector<std::int64_t> owners;
  DHPMAP_RETURN_IF_ERROR(write([&](Database& database) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(const MapRow head, ReadMapHead(database, map));
    DHPMAP_ASSIGN_OR_RETURN(owners, OwnersWithoutCells(database, head.key));
    return Status::Ok();
  }));
  for (const std::int64_t owner_key : owners) {
    constexpr auto kFirst = std::numeric_limits<std::int32_t>::min();
    RowPlace last{.index = {kFirst, kFirst, kFirst}};
    for (bool has_more = true; has_more;) {
      DHPMAP_RETURN_IF_ERROR(write([&](Database& database) -> Status {
        DHPMAP_ASSIGN_OR_RETURN(has_more, NoteSome(database, owner_key, last));
        return Status::Ok();
      }));
    }
  }
  return Status::Ok();
}

}  // namespace dhpmap

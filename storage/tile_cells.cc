// SPDX-License-Identifier: BSD-3-Clause
#include "storage/tile_cells.h"

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

/// A row of an owner that does not say its cells, or did not.
struct RowPlace {
  TileIndex index;
  std::int64_t layer = -1;  ///< before all of the tile
  std::uint64_t cells = 0;
};

Result<std::uint64_t> CellsOfBlob(ByteView blob, const RowPlace& place) {
  const ObjectLayer* layer = FindObjectLayer(place.layer);
  if (layer == nullptr) return FailedPrecondition("a tile is of a layer unknown to this version");
  BlockTile tile;
  DHPMAP_RETURN_IF_ERROR(layer->decode(blob, place.index, tile));
  return tile.cells();
}

/// The next rows after `last`, which becomes the last of them.
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
    DHPMAP_ASSIGN_OR_RETURN(row.cells, CellsOfBlob(columns.Blob(), row));
  }
  if (!rows.empty()) last = rows.back();
  return rows;
}

/// Notes some rows. Returns whether there were any.
Result<bool> NoteSome(Database& database, std::int64_t owner_key, RowPlace& last) {
  DHPMAP_ASSIGN_OR_RETURN(const std::vector<RowPlace> rows, NextRows(database, owner_key, last));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement update,
      database.Prepare("UPDATE tiles SET cells = ? WHERE owner_key = ? AND x = ? AND y = ? AND z = ? AND layer = ?",
                       kCellsTask));
  for (const RowPlace& row : rows) {
    update.Bind(static_cast<std::int64_t>(row.cells)).Bind(owner_key).Bind(row.index.x).Bind(row.index.y);
    DHPMAP_RETURN_IF_ERROR(update.Bind(row.index.z).Bind(row.layer).Run());
  }
  return !rows.empty();
}

/// Of the map's objects, those with rows that do not say their cells.
Result<std::vector<std::int64_t>> OwnersWithout(Database& database, const std::string& map) {
  DHPMAP_ASSIGN_OR_RETURN(const MapRow head, ReadMapHead(database, map));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare(
          "SELECT submap_key FROM submaps WHERE map_key = ? AND EXISTS (SELECT 1 FROM tiles WHERE owner_key "
          "= submap_key AND cells = 0)",
          kCellsTask));
  select.Bind(head.key);
  std::vector<std::int64_t> owners;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return owners;
    owners.push_back(select.Int(0));
  }
}

}  // namespace

Status NoteTileCells(const WriteRows& write, const std::string& map) {
  std::vector<std::int64_t> owners;
  DHPMAP_RETURN_IF_ERROR(write([&](Database& database) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(owners, OwnersWithout(database, map));
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

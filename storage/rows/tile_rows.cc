// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/tile_rows.h"

#include <utility>

namespace dhpmap {

using sqlite::Database;
using sqlite::Statement;

std::int64_t NumTilesOf(const MapSnapshot& map) {
  return static_cast<std::int64_t>(map.free_space()->tiles().size() + map.vacated()->tiles().size());
}

std::string TileName(std::int64_t layer, TileIndex index) {
  std::string name = "layer " + std::to_string(layer);
  if (layer == static_cast<std::int64_t>(MapLayer::kFree)) name = "free-space";
  if (layer == static_cast<std::int64_t>(MapLayer::kVacated)) name = "vacated";
  name.append(" tile (").append(std::to_string(index.x)).append(", ");
  return name.append(std::to_string(index.y)).append(", ").append(std::to_string(index.z)).append(")");
}

TileRowWriter::TileRowWriter(std::int64_t map_key, MapLayer layer, Statement find, Statement insert, Statement update,
                             Statement erase)
    : map_key_(map_key),
      layer_(static_cast<std::int64_t>(layer)),
      find_(std::move(find)),
      insert_(std::move(insert)),
      update_(std::move(update)),
      erase_(std::move(erase)) {}

Result<TileRowWriter> TileRowWriter::Prepare(Database& database, std::int64_t map_key, MapLayer layer) {
  constexpr char kTask[] = "write a tile";
  DHPMAP_ASSIGN_OR_RETURN(
      Statement find,
      database.Prepare(
          "SELECT tile_key, length(blob) FROM map_tiles WHERE map_key = ? AND layer = ? AND x = ? AND y = ? "
          "AND z = ?",
          kTask));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement insert,
      database.Prepare("INSERT INTO map_tiles (map_key, layer, x, y, z, blob) VALUES (?, ?, ?, ?, ?, ?)", kTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement update,
                          database.Prepare("UPDATE map_tiles SET blob = ? WHERE tile_key = ?", kTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase,
                          database.Prepare("DELETE FROM map_tiles WHERE tile_key = ?", "delete a tile"));
  return TileRowWriter(map_key, layer, std::move(find), std::move(insert), std::move(update), std::move(erase));
}

Result<TileRowWriter::Stored> TileRowWriter::Find(TileIndex index) {
  find_.Bind(map_key_).Bind(layer_).Bind(index.x).Bind(index.y).Bind(index.z);
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, find_.Step());
  if (!has_row) return Stored{};
  sqlite::Columns columns(find_);
  Stored stored;
  stored.key = columns.Int();
  stored.bytes = columns.Int();
  find_.Reset();
  return stored;
}

Result<BlockDelta> TileRowWriter::Write(TileIndex index, ByteView blob) {
  const auto bytes = static_cast<std::int64_t>(blob.size());
  DHPMAP_ASSIGN_OR_RETURN(const Stored stored, Find(index));
  if (stored.key != 0) {
    DHPMAP_RETURN_IF_ERROR(update_.Bind(blob).Bind(stored.key).Run());
    return BlockDelta{0, bytes - stored.bytes};
  }
  DHPMAP_RETURN_IF_ERROR(
      insert_.Bind(map_key_).Bind(layer_).Bind(index.x).Bind(index.y).Bind(index.z).Bind(blob).Run());
  return BlockDelta{1, bytes};
}

Result<BlockDelta> TileRowWriter::Erase(TileIndex index) {
  DHPMAP_ASSIGN_OR_RETURN(const Stored stored, Find(index));
  if (stored.key == 0) return BlockDelta{};
  DHPMAP_RETURN_IF_ERROR(erase_.Bind(stored.key).Run());
  return BlockDelta{-1, -stored.bytes};
}

Result<TileRowReader> TileRowReader::Prepare(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement select,
      database.Prepare("SELECT layer, x, y, z, blob FROM map_tiles WHERE map_key = ? ORDER BY layer, x, y, z",
                       "read the tiles"));
  return TileRowReader(std::move(select));
}

}  // namespace dhpmap

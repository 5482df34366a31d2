// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "mapping/map/map.h"
#include "storage/codec/bytes.h"
#include "storage/rows/block_rows.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// Layers of a map, as in column map_tiles.layer: the high half of the first byte of their blobs. Kept in files.
enum class MapLayer : std::int64_t { kFree = 3, kVacated = 5 };  // 4: of objects

/// Tiles of all layers of a map.
std::int64_t NumTilesOf(const MapSnapshot& map);

/// "free-space tile (1, -2, 0)", for messages.
std::string TileName(std::int64_t layer, TileIndex index);

/// Writes the tiles of one layer of a map. One for each transaction.
class TileRowWriter {
 public:
  static Result<TileRowWriter> Prepare(sqlite::Database& database, std::int64_t map_key, MapLayer layer);

  /// Adds or replaces a tile.
  Result<BlockDelta> Write(TileIndex index, ByteView blob);
  /// Nothing happens if there is no such tile.
  Result<BlockDelta> Erase(TileIndex index);

 private:
  struct Stored {
    std::int64_t key = 0;
    std::int64_t bytes = 0;
  };
  TileRowWriter(std::int64_t map_key, MapLayer layer, sqlite::Statement find, sqlite::Statement insert,
                sqlite::Statement update, sqlite::Statement erase);
  /// Key 0 if there is none.
  Result<Stored> Find(TileIndex index);

  std::int64_t map_key_, layer_;
  sqlite::Statement find_, insert_, update_, erase_;
};

/// Reads all tiles of a map, of all layers, by ascending index.
class TileRowReader {
 public:
  static Result<TileRowReader> Prepare(sqlite::Database& database);

  /// Calls visit(std::int64_t layer, TileIndex, ByteView blob), which returns a Status; the view lives as long as the
  /// call. Ends with the first error.
  template <typename Visitor>
  Status ForEach(std::int64_t map_key, Visitor&& visit) {
    select_.Bind(map_key);
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select_.Step());
      if (!has_row) return Status::Ok();
      sqlite::Columns columns(select_);
      const std::int64_t layer = columns.Int();
      TileIndex index;
      for (std::int32_t* coordinate : {&index.x, &index.y, &index.z}) {
        *coordinate = static_cast<std::int32_t>(columns.Int());
      }
      DHPMAP_RETURN_IF_ERROR(visit(layer, index, columns.Blob()));
    }
  }

 private:
  explicit TileRowReader(sqlite::Statement select) : select_(std::move(select)) {}
  sqlite::Statement select_;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mapping/changes/state_delta.h"
#include "storage/codec/bytes.h"
#include "storage/commit/tile_totals.h"
#include "storage/rows/edit_rows.h"
#include "storage/rows/map_row.h"
#include "storage/store.h"

namespace dhpmap {

// Undo data of edits, as every store keeps them: rows as blobs, tiles as references to blobs.

inline constexpr std::int64_t kMapsOwnTiles = -1;       ///< column edit_tiles.submap_id
inline constexpr std::int64_t kMostTilesTrimmed = 256;  ///< rows of edit_tiles deleted by one edit
/// What a row of edit_tiles counts.
inline constexpr std::int64_t kEditTileBytes = 64;

/// A row of edit_tiles, with its blobs.
struct EditTileRow {
  std::int64_t submap_id = 0;
  TileIndex index;
  std::int64_t layer = 0;
  std::int64_t before_key = 0, after_key = 0;
  ByteView before, after;  ///< as long as the statement is at the row
};

/// Reads submap_id, x, y, z, layer, before_key and after_key; no blobs.
EditTileRow ReadEditTileRow(RowColumns& columns);

/// Adds a row to what an edit did. Rows come by submap, then tile; `store`: for the keys of tiles. Errors continue
/// after "what undoes edit 3".
Status AddEditTileTo(const EditTileRow& row, std::uint16_t store, StateDelta& delta);

/// Adds a row of edit_tiles to the sum of its edit, as two rows of tiles.
void AddEditTile(TileTotals& totals, std::int64_t submap_id, TileIndex index, std::int64_t layer,
                 std::int64_t before_key, std::int64_t after_key);

/// Over all tiles of an edit: the sum of their rows, and the bytes of blobs and rows.
struct EditTileSums {
  std::int64_t num_bytes = 0;
  std::int64_t sum = 0;
};
/// The undo data of an edit without its tiles, sealed.
EditHistoryRow EditHistoryRowOf(std::int64_t map_key, std::int64_t edit_key, const EditRecord& edit,
                                const MapSnapshot& after, const EditTileSums& tiles);

/// The error for undo data that are not what was written.
Status DamagedHistory(const MapRow& map, std::int64_t revision, const std::string& what);
/// The error for an edit without undo data; names the oldest edit that has them.
Status UndoNotKept(std::int64_t revision, std::optional<std::int64_t> oldest_edit);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "storage/commit/state_tables.h"
#include "storage/history/edit_tiles.h"
#include "storage/postgres/answer.h"
#include "storage/postgres/tiles/tile_writes.h"
#include "storage/postgres/values.h"
#include "storage/rows/edit_rows.h"

namespace dhpmap::postgres {

/// The undo data of one edit during a commit.
class EditTileWrites final : public EditTiles {
 public:
  /// `edit_key`: the revision of the edit. `tiles` outlives it.
  EditTileWrites(std::int64_t edit_key, TileWrites& tiles) : edit_key_(edit_key), tiles_(tiles) {}

  /// Stored rows of the edit, for a commit that adds to them: see TilesOfEdit.
  void Fetched(Answer& rows);

  Status Note(std::int64_t submap_id, TileIndex index, std::int64_t layer, const StoredBlob& before,
              const StoredBlob& after) override;
  Status NoteNew(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes, bool is_counted) override;
  Status NoteRemoved(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes) override;

  [[nodiscard]] EditTileSums sums() const { return {totals_.bytes, totals_.sum}; }
  [[nodiscard]] std::int64_t edit_key() const { return edit_key_; }
  void Write(std::int64_t map_key, std::vector<Call>& calls) const;

 private:
  struct Place {
    std::int64_t submap_id = 0;
    std::int32_t x = 0, y = 0, z = 0;
    std::int64_t layer = 0;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  struct Tile {
    std::int64_t before = 0, after = 0;
    bool is_changed = false;
  };
  void NoteAll(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes, bool are_before, std::int64_t num_more);

  const std::int64_t edit_key_;
  TileWrites& tiles_;
  std::map<Place, Tile> rows_;
  TileTotals totals_;
};

/// The map's own tiles among the undo data of edit $2: a SELECT by map_key ($1).
const std::string& OwnTilesOfEdit();

}  // namespace dhpmap::postgres

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "storage/commit/state_tables.h"
#include "storage/history/edit_tiles.h"
#include "storage/postgres/answer.h"
#include "storage/postgres/commit/tile_writes.h"
#include "storage/postgres/values.h"
#include "storage/rows/edit_rows.h"
#include "storage/store.h"

namespace dhpmap::postgres {

/// The undo data of one edit during a commit.
class EditTileWrites final : public EditTiles {
 public:
  /// `edit_key`: the revision of the edit. `tiles` outlives it.
  EditTileWrites(std::int64_t edit_key, TileWrites& tiles) : edit_key_(edit_key), tiles_(tiles) {}

  /// Rows of the edit that are there already, of a commit that goes on with it: see TilesOfEdit.
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

/// The edit log of a map and its undo data during a commit: what was fetched of them, and what is to be written.
class EditWrites {
 public:
  // Answers to the statements below.
  void FetchedTotals(Answer& totals);
  void FetchedOldEdits(Answer& edits);
  void FetchedOldHistories(Answer& histories);

  /// Adds the edit to the log and trims it.
  void Record(std::int64_t map_key, const EditRecord& edit, std::int64_t now_ns, const EditLogLimits& limits,
              std::vector<Call>& calls);
  /// Adds its undo data.
  void Keep(const EditHistoryRow& history, std::int64_t now_ns, const EditTileWrites& tiles, std::vector<Call>& calls);
  /// Adds to undo data that are there; `history` is their row.
  void GoOn(EditHistoryRow history, std::int64_t now_ns, const EditTileWrites& tiles, std::vector<Call>& calls);
  /// Trims undo data, and writes the totals. Last.
  void Finish(std::int64_t map_key, std::int64_t now_ns, const EditLogLimits& limits, std::vector<Call>& calls);

 private:
  struct OldEdit {
    std::int64_t revision = 0, seen_ns = 0, num_bytes = 0;
  };
  struct OldHistory {
    std::int64_t edit_key = 0, seen_ns = 0, num_bytes = 0, num_tiles = 0;
  };
  void TrimLog(std::int64_t map_key, std::int64_t newest, std::int64_t now_ns, const EditLogLimits& limits,
               std::vector<Call>& calls);
  void Forget(const OldHistory& history, std::vector<std::int64_t>& forgotten);
  [[nodiscard]] bool IsBeyondHistories(const OldHistory& oldest, std::int64_t now_ns,
                                       const EditLogLimits& limits) const;

  std::int64_t num_edits_ = 0, edit_bytes_ = 0, num_histories_ = 0, history_bytes_ = 0;
  std::vector<OldEdit> edits_;
  std::vector<OldHistory> histories_;    ///< the oldest, and what this commit adds
  std::vector<std::int64_t> forgotten_;  ///< histories of edits that leave the log
};

// SELECTs by map_key ($1).
const std::string& TotalsOfEdits();
const std::string& OldestEdits();
const std::string& OldestHistories();
/// The undo data of the newest edit, if they are kept.
const std::string& NewestHistory();
/// The map's own tiles among the undo data of edit $2.
const std::string& OwnTilesOfEdit();

}  // namespace dhpmap::postgres

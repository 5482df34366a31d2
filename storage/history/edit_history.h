// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "storage/commit/state_tables.h"
#include "storage/history/edit_tiles.h"
#include "storage/rows/map_rows.h"
#include "storage/rows/tile_rows.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// Undo data of edits: rows as blobs, tiles as references to blobs, which they keep alive.

/// Records the blobs of tiles before and after an edit, within the edit's transaction. One for each edit.
class EditTileRecorder final : public EditTiles {
 public:
  static Result<EditTileRecorder> Prepare(sqlite::Database& database, std::int64_t edit_key);

  Status Note(std::int64_t submap_id, TileIndex index, std::int64_t layer, const StoredBlob& before,
              const StoredBlob& after) override;
  Status NoteNew(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes, bool is_counted) override;
  Status NoteRemoved(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes) override;

  /// Over everything recorded: the sum of the rows, and the bytes of blobs and rows.
  [[nodiscard]] std::int64_t tiles_sum() const { return totals_.sum; }
  [[nodiscard]] std::int64_t num_bytes() const { return totals_.bytes; }
  [[nodiscard]] std::int64_t edit_key() const { return edit_key_; }

 private:
  explicit EditTileRecorder(std::int64_t edit_key) : edit_key_(edit_key) {}
  enum class Side { kBefore, kAfter };
  Status NoteFurther(std::int64_t submap_id, TileIndex index, std::int64_t layer, const StoredBlob& between,
                     const StoredBlob& after);
  friend Result<std::optional<EditTileRecorder>> RecorderOfLeft(sqlite::Database& database, const MapRow& map);
  Status NoteAll(Side side, SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes);
  using OptionalStatement = std::optional<sqlite::Statement>;
  std::int64_t edit_key_;
  OptionalStatement insert_, share_, note_new_, note_removed_, share_all_, rows_, find_, erase_;
  bool goes_on_ = false;  ///< rows of the edit may exist already: several of its objects may have left the same tile
  TileTotals totals_;
};

/// Writes the remaining undo data. `tiles`: the recorded ones.
Status RecordHistory(sqlite::Database& database, std::int64_t map_key, std::int64_t edit_key, const EditRecord& edit,
                     const MapSnapshot& after, const EditTileRecorder& tiles);
/// For the space vacated by the map's last edit, if it is still to be written and the edit's undo data are kept.
Result<std::optional<EditTileRecorder>> RecorderOfLeft(sqlite::Database& database, const MapRow& map);
/// Adds recorded tiles to that edit's undo data, then trims.
Status AddToHistory(sqlite::Database& database, const EditTileRecorder& left, std::int64_t now_ns,
                    const EditLogLimits& limits);
/// Deletes undo data beyond the limits at `now_ns` of SeenClock: first the newest if it alone exceeds them, then the
/// oldest. Deletes little more than kMostTilesTrimmed tiles, so that no edit waits long, but at least one edit's data,
/// because each edit adds one.
Status TrimHistories(sqlite::Database& database, std::int64_t map_key, std::int64_t now_ns,
                     const EditLogLimits& limits);

/// See MapStore::LoadEdit. `store`: for the keys of tiles.
Result<StateDelta> ReadHistory(sqlite::Database& database, const MapRow& map, std::int64_t revision,
                               std::uint16_t store);

}  // namespace dhpmap

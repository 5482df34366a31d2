// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "storage/rows/map_rows.h"
#include "storage/rows/tile_rows.h"
#include "storage/sqlite/database.h"
#include "storage/store.h"

namespace dhpmap {

// What it takes to undo an edit: rows as blobs, tiles as references to blobs. As long as it is kept, so are these.

inline constexpr std::int64_t kMapsOwnTiles = -1;       ///< column edit_tiles.submap_id
inline constexpr std::int64_t kMostTilesTrimmed = 256;  ///< rows of edit_tiles, with one edit

/// Notes which blobs the tiles were before an edit and are after it, within the edit's transaction. One for each edit.
class EditTileRecorder {
 public:
  static Result<EditTileRecorder> Prepare(sqlite::Database& database, std::int64_t edit_key);

  /// Before a row of tiles is changed, from one blob to another; a key of 0: there was none, or will be.
  Status Note(std::int64_t submap_id, TileIndex index, std::int64_t layer, const StoredBlob& before,
              const StoredBlob& after);
  /// All rows of an owner that is new, once they are there, with the bytes of their blobs. `is_counted`: these count
  /// one more already that refers to them.
  Status NoteNew(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes, bool is_counted);
  /// All rows of an owner, before they go, likewise.
  Status NoteRemoved(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes);

  /// Of all that was noted: the sum over the rows, and the bytes of the blobs and rows.
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
  bool goes_on_ = false;  ///< some rows of the edit may be there: several of its objects may have left the same tile
  TileTotals totals_;
};

/// What a row of edit_tiles adds to the sum over the rows of its edit, by that of two rows of tiles.
void AddEditTile(TileTotals& totals, std::int64_t submap_id, TileIndex index, std::int64_t layer,
                 std::int64_t before_key, std::int64_t after_key);

/// Writes the rest of it. `tiles`: what was noted.
Status RecordHistory(sqlite::Database& database, std::int64_t map_key, std::int64_t edit_key, const EditRecord& edit,
                     const MapSnapshot& after, const EditTileRecorder& tiles);
/// For what the map's last edit has left, if that is still to be written, and it is kept what undoes the edit.
Result<std::optional<EditTileRecorder>> RecorderOfLeft(sqlite::Database& database, const MapRow& map);
/// Adds to what is kept of that edit what was noted, and deletes what is beyond the limits then.
Status AddToHistory(sqlite::Database& database, const EditTileRecorder& left, std::int64_t now_ns,
                    const EditLogLimits& limits);
/// Deletes some of what is beyond the limits at the time `now_ns` of SeenClock, the oldest first, and first of all the
/// newest, if it alone is larger than they allow. Of tiles few more than kMostTilesTrimmed, so that no edit waits long
/// for what others left, but one edit's at least, as it adds one.
Status TrimHistories(sqlite::Database& database, std::int64_t map_key, std::int64_t now_ns,
                     const EditLogLimits& limits);

/// See MapStore::LoadEdit. `store`: for the keys of tiles.
Result<StateDelta> ReadHistory(sqlite::Database& database, const MapRow& map, std::int64_t revision,
                               std::uint16_t store);

/// What is answered for an edit that is not kept; of which is the oldest that is.
Status UndoNotKept(std::int64_t revision, std::optional<std::int64_t> oldest_edit);

}  // namespace dhpmap

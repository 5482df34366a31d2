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

inline constexpr std::int64_t kMapsOwnTiles = -1;  ///< column edit_tiles.submap_id

/// Notes which blobs the tiles were before an edit and are after it, within the edit's transaction. One for each edit.
class EditTileRecorder {
 public:
  static Result<EditTileRecorder> Prepare(sqlite::Database& database, std::int64_t edit_key);

  /// Before a row of tiles is changed, from one blob to another; 0: there was none, or will be.
  Status Note(std::int64_t submap_id, TileIndex index, std::int64_t layer, std::int64_t before_key,
              std::int64_t after_key);
  /// All rows of an owner that is new, once they are there.
  Status NoteNew(SubmapId id, std::int64_t owner_key) { return NoteAll(note_new_, id, owner_key); }
  /// All rows of an owner, before they go.
  Status NoteRemoved(SubmapId id, std::int64_t owner_key) { return NoteAll(note_removed_, id, owner_key); }

 private:
  EditTileRecorder(std::int64_t edit_key, sqlite::Statement insert, sqlite::Statement share, sqlite::Statement note_new,
                   sqlite::Statement note_removed, sqlite::Statement share_all);
  Status NoteAll(sqlite::Statement& note, SubmapId id, std::int64_t owner_key);
  std::int64_t edit_key_;
  sqlite::Statement insert_, share_, note_new_, note_removed_, share_all_;
};

/// Writes the rest of it.
Status RecordHistory(sqlite::Database& database, std::int64_t map_key, std::int64_t edit_key, const EditRecord& edit,
                     const MapSnapshot& after);
/// Deletes some of what is beyond the limits at the time `now_ns`, the oldest first, and first of all the newest, if it
/// alone is larger than they allow.
Status TrimHistories(sqlite::Database& database, std::int64_t map_key, std::int64_t now_ns,
                     const EditLogLimits& limits);

/// See MapStore::LoadEdit. `store`: for the keys of tiles.
Result<StateDelta> ReadHistory(sqlite::Database& database, const MapRow& map, std::int64_t revision,
                               std::uint16_t store);

/// What is answered for an edit that is not kept; of which is the oldest that is.
Status UndoNotKept(std::int64_t revision, std::optional<std::int64_t> oldest_edit);

}  // namespace dhpmap

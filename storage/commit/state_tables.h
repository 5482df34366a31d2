// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "mapping/base/result.h"
#include "mapping/submap/submap.h"
#include "storage/commit/tile_totals.h"
#include "storage/tiles/object_layers.h"

namespace dhpmap {

// What a commit reads and writes of a state, whatever database holds it: SnapshotWriter and WriteMapLayers decide,
// these do it. Each lives as long as one transaction. Errors are those of the database.

/// Rows of tiles, and blobs.
class TileTable {
 public:
  virtual Result<StoredLayers> Find(std::int64_t owner_key, TileIndex index) = 0;
  /// Recomputes the totals from all rows, for an owner without stored ones.
  virtual Result<TileTotals> Count(std::int64_t owner_key) = 0;

  /// Writes a new blob, for one row.
  virtual Result<StoredBlob> Insert(ByteView blob, std::int64_t num_blocks) = 0;
  /// Call if others than this table released blobs in this transaction.
  virtual void NoteDeadBlobs() = 0;

  /// Adds a reference to an existing blob; nothing if it is gone.
  virtual Result<std::optional<StoredBlob>> Share(std::int64_t blob_key) = 0;

  /// Adds rows for a new owner that refer to the blobs of another. `num_more`: references added to each; 2 if the
  /// edit's undo data refer to them, too.
  virtual Status Copy(std::int64_t from_owner_key, std::int64_t to_owner_key, std::int64_t num_more) = 0;
  /// Adds the row, or changes its blob.
  virtual Status Put(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
                     const StoredBlob& after, TileTotals& totals) = 0;
  virtual Status Erase(std::int64_t owner_key, TileIndex index, std::int64_t layer, const StoredBlob& before,
                       TileTotals& totals) = 0;

 protected:
  ~TileTable() = default;
};

/// Rows of submaps.
class SubmapTable {
 public:
  struct Stored {
    std::int64_t key = 0;  ///< as owner of tiles
    SubmapCounts counts;
    std::int64_t tiles_sum = 0;
    bool covers_tiles = false;  ///< tiles_sum is valid
  };
  /// Nothing if the map has no such submap.
  virtual Result<std::optional<Stored>> Find(std::int64_t map_key, SubmapId id) = 0;
  /// Adds or replaces a row. Returns its key.
  virtual Result<std::int64_t> Write(std::int64_t map_key, const Submap& submap, const SubmapCounts& counts,
                                     std::int64_t tiles_sum) = 0;
  /// Including its tiles.
  virtual Status Erase(std::int64_t submap_key) = 0;

 protected:
  ~SubmapTable() = default;
};

/// Blobs of tiles before and after an edit, which its undo data keep alive. One for each edit.
class EditTiles {
 public:
  /// Call before a row of tiles changes from one blob to another; key 0: no row.
  virtual Status Note(std::int64_t submap_id, TileIndex index, std::int64_t layer, const StoredBlob& before,
                      const StoredBlob& after) = 0;
  /// Records all rows of a new owner, after they are written, with the bytes of their blobs. `is_counted`: the blobs'
  /// reference counts include this one already.
  virtual Status NoteNew(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes, bool is_counted) = 0;
  /// Likewise, all rows of an owner before they are deleted.
  virtual Status NoteRemoved(SubmapId id, std::int64_t owner_key, std::int64_t blob_bytes) = 0;

 protected:
  ~EditTiles() = default;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "storage/codec/bytes.h"
#include "storage/rows/map_parts.h"
#include "storage/rows/map_row.h"
#include "storage/rows/submap_rows.h"
#include "storage/sqlite/database.h"
#include "storage/sqlite/transaction.h"

namespace dhpmap {

/// A tile of a map that goes into a file.
struct TileOfMap {
  std::int64_t submap_id = 0;  ///< below 0: of the map itself
  TileIndex index;
  std::int64_t layer = 0;
  std::int64_t blob_key = 0;
  std::uint64_t cells = 0, extent = 0;
};

/// Writes the map of a store that is no SQLite file into one, row by row, in little memory: what WriteMapFile makes of
/// a SQLite store. Call in this order: AddMap; AddSubmap for each; AddTile for each; AddBlob for each, once; Finish.
/// Rows are intact. The same rows give the same file. Thread-compatible.
class NewMapFile {
 public:
  /// `file`: see MakeMapFile; outlives it.
  static Result<NewMapFile> Begin(sqlite::Database& file);

  /// `map`: with the checksums of `parts`.
  Status AddMap(const MapRow& map, MapParts parts);
  Status AddSubmap(SubmapRow submap);
  /// DATA_LOSS for a tile of a submap that was not added.
  Status AddTile(const TileOfMap& tile);
  Status AddBlob(std::int64_t blob_key, std::int64_t num_blocks, ByteView blob);
  Status Finish();

 private:
  NewMapFile(sqlite::Database& file, sqlite::Transaction transaction, SubmapRowWriter submaps, sqlite::Statement tile,
             sqlite::Statement blob);

  sqlite::Database* file_;
  sqlite::Transaction transaction_;
  SubmapRowWriter submap_writer_;
  sqlite::Statement insert_tile_, insert_blob_;
  std::int64_t map_key_ = 0;
  std::map<std::int64_t, std::int64_t> submap_keys_;  ///< in the file, by id
};

}  // namespace dhpmap

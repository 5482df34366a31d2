// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "mapping/base/grid.h"
#include "storage/codec/bytes.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// The tables of blobs of blocks.
enum class Layer { kTsdf, kLabels, kGone };
std::string_view LayerName(Layer layer);

/// "submap 3: tsdf block (1, -2, 0)", for messages.
std::string BlockName(std::uint32_t submap_id, Layer layer, BlockIndex index);

/// By how much a write changed a table.
struct BlockDelta {
  std::int64_t rows = 0;
  std::int64_t bytes = 0;
};

/// Writes the rows of one layer. One for each transaction.
class BlockRowWriter {
 public:
  static Result<BlockRowWriter> Prepare(sqlite::Database& database, Layer layer);

  /// Adds or replaces a block. `is_new`: the submap has none yet, so there is no need to look.
  Result<BlockDelta> Write(std::int64_t submap_key, BlockIndex index, ByteView blob, bool is_new);
  /// Nothing happens if there is no such block.
  Result<BlockDelta> Erase(std::int64_t submap_key, BlockIndex index);

 private:
  struct Stored {
    std::int64_t key = 0;
    std::int64_t bytes = 0;
  };
  BlockRowWriter(sqlite::Statement find, sqlite::Statement insert, sqlite::Statement update, sqlite::Statement erase);
  /// Key 0 if there is none.
  Result<Stored> Find(std::int64_t submap_key, BlockIndex index);
  sqlite::Statement find_, insert_, update_, erase_;
};

/// Reads the blocks of one layer, submap by submap, by ascending index.
class BlockRowReader {
 public:
  static Result<BlockRowReader> Prepare(sqlite::Database& database, Layer layer);

  /// Calls visit(BlockIndex, ByteView blob); the view lives as long as the call.
  template <typename Visitor>
  Status ForEach(std::int64_t submap_key, Visitor&& visit) {
    select_.Bind(submap_key);
    for (;;) {
      DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select_.Step());
      if (!has_row) return Status::Ok();
      sqlite::Columns columns(select_);
      BlockIndex index;
      for (std::int32_t* coordinate : {&index.x, &index.y, &index.z}) {
        *coordinate = static_cast<std::int32_t>(columns.Int());
      }
      visit(index, columns.Blob());
    }
  }

 private:
  explicit BlockRowReader(sqlite::Statement select) : select_(std::move(select)) {}
  sqlite::Statement select_;
};

}  // namespace dhpmap

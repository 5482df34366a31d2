// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "mapping/map/submap.h"
#include "storage/sqlite/database.h"

namespace dhpmap {

/// How many blocks of each layer a submap has, and the size of their blobs.
struct SubmapCounts {
  std::int64_t num_tsdf_blocks = 0;
  std::int64_t num_label_blocks = 0;
  std::int64_t blob_bytes = 0;
};
/// Of a submap in memory; leaves blob_bytes at 0.
SubmapCounts CountBlocks(const Submap& submap);

struct SubmapRow {
  std::int64_t key = 0;
  SubmapInfo info;
  BoundingSphere sphere;
  SubmapCounts counts;
};

/// The rows of a map, by ascending submap id. DATA_LOSS, naming the submap, where a row does not match its checksum.
Result<std::vector<SubmapRow>> ReadSubmaps(sqlite::Database& database, std::int64_t map_key);

/// Writes submap rows, their boxes, and their counts. One for each transaction.
class SubmapRowWriter {
 public:
  static Result<SubmapRowWriter> Prepare(sqlite::Database& database);

  struct Stored {
    std::int64_t key = 0;
    SubmapCounts counts;
  };
  /// Nothing if the map has no such submap.
  Result<std::optional<Stored>> Find(std::int64_t map_key, SubmapId id);

  /// Adds or replaces a row, with the number of blocks that `submap` has. Returns its key.
  Result<std::int64_t> Write(std::int64_t map_key, const Submap& submap);
  Status SetBlobBytes(std::int64_t submap_key, std::int64_t blob_bytes);
  /// With its blocks.
  Status Erase(std::int64_t submap_key);

 private:
  SubmapRowWriter(sqlite::Statement find, sqlite::Statement upsert, sqlite::Statement set_bytes,
                  sqlite::Statement erase, sqlite::Statement write_box, sqlite::Statement erase_box);
  sqlite::Statement find_, upsert_, set_bytes_, erase_, write_box_, erase_box_;
};

}  // namespace dhpmap

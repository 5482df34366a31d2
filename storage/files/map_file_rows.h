// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "storage/codec/bytes.h"
#include "storage/files/map_file.h"
#include "storage/rows/map_row.h"
#include "storage/rows/submap_rows.h"
#include "storage/sqlite/statement.h"

namespace dhpmap {

// What a store takes over from an opened map file, within a read transaction on it. DATA_LOSS, reason DAMAGED_MAP.

/// The file's own rows, with the keys that they have there.
struct FileHead {
  MapRow map;
  std::vector<SubmapRow> submaps;  ///< ascending; the unknown submap first
};
Result<FileHead> ReadFileHead(MapFile& file);

/// Keys of the blobs that a file's map refers to, ascending.
class BlobKeys {
 public:
  BlobKeys() = default;
  /// CANCELLED.
  static Result<BlobKeys> Of(MapFile& file, const std::stop_token& stop);

  [[nodiscard]] std::size_t size() const { return keys_.size(); }
  [[nodiscard]] std::int64_t operator[](std::size_t rank) const { return keys_[rank]; }
  /// Its place among them; nothing if it is none.
  [[nodiscard]] std::optional<std::size_t> RankOf(std::int64_t blob_key) const;

 private:
  explicit BlobKeys(std::vector<std::int64_t> keys) : keys_(std::move(keys)) {}
  std::vector<std::int64_t> keys_;
};

struct FileBlob {
  std::int64_t num_blocks = 0;
  Bytes bytes;
};
/// Blobs from the one of rank `first` on, until they have that many bytes: one at least.
Result<std::vector<FileBlob>> ReadSomeBlobs(MapFile& file, const BlobKeys& keys, std::size_t first,
                                            std::size_t num_bytes);

/// Sizes of a blob that was taken over, so that rows can be written without reading it again.
struct BroughtSize {
  std::uint32_t num_blocks = 0, bytes = 0;
};
BroughtSize SizeOf(const FileBlob& blob);

/// The rows of tiles, without blobs.
class FileTiles {
 public:
  struct Row {
    TileIndex index;
    std::int64_t layer = 0;
    std::int64_t blob_key = 0;
    std::uint64_t cells = 0, extent = 0;
  };
  static Result<FileTiles> Prepare(MapFile& file);
  /// Stops at the first error of `visit`.
  Status ForEach(std::int64_t owner_key, const std::function<Status(const Row&)>& visit);

 private:
  explicit FileTiles(sqlite::Statement select) : select_(std::move(select)) {}
  sqlite::Statement select_;
};

/// The error for a tile whose blob is not in the file.
Status MissingTile();

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "storage/files/map_file.h"
#include "storage/rows/kept_blobs.h"
#include "storage/store.h"

namespace dhpmap {

/// What an import needs of the store that it is for.
struct ImportTarget {
  /// Runs its argument as one transaction of the writer, in its turn even where commits follow upon each other.
  std::function<Status(Durability, const std::function<Status(sqlite::Database&)>&)> write;
  KeptBlobs& kept;  ///< outlives the import
};

/// Of a blob that was brought: so that rows which refer to it are written without reading the file again.
struct BroughtSize {
  std::uint32_t num_blocks = 0, bytes = 0;
};

/// Takes the map of a file over into a database: first its blobs, in steps between which commits go on, then its rows,
/// which refer to them, in one transaction. What is not finished leaves blobs that are collected. Thread-compatible.
class MapCopy {
 public:
  MapCopy(MapFile file, ImportTarget target) : file_(std::move(file)), target_(std::move(target)) {}
  ~MapCopy();
  MapCopy(const MapCopy&) = delete;
  MapCopy& operator=(const MapCopy&) = delete;

  /// Once. As fast as the disk; needs the memory of a step, and 20 bytes a blob. CANCELLED.
  Status BringBlobs(const std::stop_token& stop);
  /// Once, after that; in full, under `name` and with a new history. ALREADY_EXISTS.
  Status AddRows(const std::string& name);

 private:
  Status ListBlobs(const std::stop_token& stop);
  Status BringStep(std::size_t& next);
  Status WriteRows(sqlite::Database& database, const std::string& name);
  [[nodiscard]] std::int64_t NewKeyOf(std::size_t rank) const { return keys_->first + static_cast<std::int64_t>(rank); }

  MapFile file_;
  const ImportTarget target_;
  std::vector<std::int64_t> blobs_;  ///< keys in the file of the blobs that the map refers to, ascending
  std::vector<BroughtSize> sizes_;   ///< of the same, once they are brought
  std::optional<BlobRange> keys_;    ///< of the same in the database, in the same order; kept there
};

}  // namespace dhpmap

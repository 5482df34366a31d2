// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "storage/files/map_file_rows.h"
#include "storage/files/map_taker.h"
#include "storage/rows/kept_blobs.h"
#include "storage/store.h"

namespace dhpmap {

/// Access of an import to its store.
struct ImportTarget {
  /// Runs its argument as one transaction of the writer, in its turn even under continuous commits.
  std::function<Status(Durability, const std::function<Status(sqlite::Database&)>&)> write;
  KeptBlobs& kept;  ///< outlives the import
};

/// Copies the map of a file into a database: first its blobs, in steps between commits, then its rows in one
/// transaction. An unfinished copy leaves only blobs that will be collected. Thread-compatible.
class MapCopy final : public MapTaker {
 public:
  MapCopy(MapFile file, ImportTarget target) : file_(std::move(file)), target_(std::move(target)) {}
  ~MapCopy() override;
  MapCopy(const MapCopy&) = delete;
  MapCopy& operator=(const MapCopy&) = delete;

  /// Call once. Limited by the disk; needs memory for a step, and 20 bytes a blob. CANCELLED.
  Status Bring(const std::stop_token& stop) override;
  /// Call once, afterwards; adds the whole map under `name`, with a new history. ALREADY_EXISTS.
  Status Add(const std::string& name) override;

 private:
  Status BringStep();
  Status WriteRows(sqlite::Database& database, const std::string& name);
  [[nodiscard]] std::int64_t NewKeyOf(std::size_t rank) const { return keys_->first + static_cast<std::int64_t>(rank); }

  MapFile file_;
  const ImportTarget target_;
  BlobKeys blobs_;                  ///< in the file
  std::vector<BroughtSize> sizes_;  ///< their sizes, once copied
  std::optional<BlobRange> keys_;   ///< their keys in the database, in the same order; protected from collection
};

}  // namespace dhpmap

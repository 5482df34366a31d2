// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/paging/tile_page.h"
#include "storage/connection.h"
#include "storage/paging/tile_expiry.h"

namespace dhpmap {

/// Reads tiles of open maps that were left on the disk. Outlives the store where somebody still has such a map.
/// Thread-safe.
class TileBlobs {
 public:
  /// As ReaderPool.
  TileBlobs(std::string path, sqlite::OpenMode mode, int busy_timeout_ms)
      : readers_(std::make_unique<ReaderPool>(std::move(path), mode, busy_timeout_ms)) {}

  /// The blocks of a tile, by ascending cell. As TileSource says, and errors of SQLite. `name`, of the owner, is for
  /// errors.
  Result<std::vector<BlockEntry>> Read(const std::string& name, const TileOwner& owner, const TileOnDisk& tile)
      DHPMAP_EXCLUDES(mutex_);

  /// Gives read(database) a connection; what it returns is a Result. UNAVAILABLE once the store is closed, and errors
  /// of SQLite.
  template <typename Value, typename Reader>
  Result<Value> With(const std::string& name, Reader&& read) DHPMAP_EXCLUDES(mutex_) {
    DHPMAP_RETURN_IF_ERROR(Begin(name));
    const Reading reading(*this);  // also if memory does not suffice
    DHPMAP_ASSIGN_OR_RETURN(ReaderPool::Lease lease, readers_->Borrow());
    return read(*lease);
  }

  /// Waits for those who read, and lets go of the file.
  void Close() DHPMAP_EXCLUDES(mutex_);

 private:
  /// One who was counted as reading, until the end of its life.
  class Reading {
   public:
    explicit Reading(TileBlobs& blobs) : blobs_(blobs) {}
    ~Reading();
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    TileBlobs& blobs_;
  };

  /// Counts the caller as reading.
  Status Begin(const std::string& name) DHPMAP_EXCLUDES(mutex_);

  Mutex mutex_;
  CondVar is_idle_;
  int num_reading_ DHPMAP_GUARDED_BY(mutex_) = 0;
  bool is_closed_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::unique_ptr<ReaderPool> readers_;  ///< changed by Close alone, while nobody reads
};

}  // namespace dhpmap

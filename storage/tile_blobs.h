// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/map/tile_page.h"
#include "storage/connection.h"
#include "storage/tile_expiry.h"

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

  Mutex mutex_;
  CondVar is_idle_;
  int num_reading_ DHPMAP_GUARDED_BY(mutex_) = 0;
  bool is_closed_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::unique_ptr<ReaderPool> readers_;  ///< changed by Close alone, while nobody reads
};

/// Of one submap, which errors name.
class SubmapTiles final : public TileSource {
 public:
  SubmapTiles(std::shared_ptr<TileBlobs> blobs, const std::string& map, SubmapId submap, const TileOwner& owner)
      : blobs_(std::move(blobs)), name_("map '" + map + "': submap " + std::to_string(submap.value)), owner_(owner) {}
  Result<std::vector<BlockEntry>> Read(const TileOnDisk& tile) override { return blobs_->Read(name_, owner_, tile); }

 private:
  const std::shared_ptr<TileBlobs> blobs_;
  const std::string name_;
  const TileOwner owner_;
};

}  // namespace dhpmap

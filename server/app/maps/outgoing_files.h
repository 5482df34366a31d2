// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/store.h"

namespace dhpmap {

/// Exports and backups being downloaded. Each occupies disk space while open, so their number is limited; one whose
/// client has stopped reading is evicted for a new one. Thread-safe.
class OutgoingFiles {
 public:
  using Clock = std::chrono::steady_clock;
  using Opened = Result<std::unique_ptr<StoreBackup>>;

  OutgoingFiles(std::size_t max, Clock::duration idle) : max_(max), idle_(idle) {}

  /// The file from open(), which may take long. RESOURCE_EXHAUSTED, reason TOO_BUSY, if all places have active readers.
  /// The file may outlive this; an evicted one fails with ABORTED, reason DOWNLOAD_EVICTED.
  Opened Open(const std::function<Opened()>& open) DHPMAP_EXCLUDES(mutex_);

 private:
  struct Place {
    Mutex mutex;  ///< locked after that of the list
    std::unique_ptr<StoreBackup> file DHPMAP_GUARDED_BY(mutex);
    /// None while it is being opened.
    Clock::time_point read_last DHPMAP_GUARDED_BY(mutex) = Clock::time_point::max();
  };
  class File;

  std::shared_ptr<Place> TakePlace() DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] bool LetGoIfIdle(Place& place) const;

  const std::size_t max_;
  const Clock::duration idle_;
  Mutex mutex_;
  std::vector<std::weak_ptr<Place>> places_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

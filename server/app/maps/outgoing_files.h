// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/store.h"

namespace dhpmap {

/// Exports and backups that clients fetch. Each takes its size of the disk for as long as it is open, so there are only
/// so many at once; one that nobody reads on makes place when another is wanted. Thread-safe.
class OutgoingFiles {
 public:
  using Clock = std::chrono::steady_clock;
  using Opened = Result<std::unique_ptr<StoreBackup>>;

  OutgoingFiles(std::size_t max, Clock::duration idle) : max_(max), idle_(idle) {}

  /// What open() makes, which may take long. RESOURCE_EXHAUSTED, reason TOO_BUSY, if there are as many as may be, all
  /// of them being read. The file may outlive this; one that had to make place reads as ABORTED, reason
  /// DOWNLOAD_EVICTED.
  Opened Open(const std::function<Opened()>& open) DHPMAP_EXCLUDES(mutex_);

 private:
  struct Place {
    Mutex mutex;  ///< taken after that of all
    std::unique_ptr<StoreBackup> file DHPMAP_GUARDED_BY(mutex);
    /// None while it is opened.
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

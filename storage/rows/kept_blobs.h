// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// First and last key of blobs.
struct BlobRange {
  std::int64_t first = 0, last = -1;
  friend bool operator==(const BlobRange&, const BlobRange&) = default;
};

/// Blobs that are listed as dead but protected, because an import will refer to them. Known only to this process; after
/// its end they are collected like others. Thread-safe.
class KeptBlobs {
 public:
  /// `range` must not overlap protected keys.
  void Keep(BlobRange range) {
    const MutexLock lock(mutex_);
    ranges_.insert(std::upper_bound(ranges_.begin(), ranges_.end(), range,
                                    [](const BlobRange& a, const BlobRange& b) { return a.first < b.first; }),
                   range);
  }
  void LetGo(BlobRange range) {
    const MutexLock lock(mutex_);
    std::erase(ranges_, range);
  }
  /// All other keys, ascending.
  [[nodiscard]] std::vector<BlobRange> Others() const {
    const MutexLock lock(mutex_);
    std::vector<BlobRange> others;
    std::int64_t next = 0;  // no blob has this key
    for (const BlobRange& range : ranges_) {
      if (next < range.first) others.push_back({next, range.first - 1});
      next = range.last + 1;  // cannot overflow: keys are far below the maximum
    }
    others.push_back({next, std::numeric_limits<std::int64_t>::max()});
    return others;
  }

 private:
  mutable Mutex mutex_;
  std::vector<BlobRange> ranges_ DHPMAP_GUARDED_BY(mutex_);  ///< by their keys
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// Keys of blobs from the first to the last.
struct BlobRange {
  std::int64_t first = 0, last = -1;
  friend bool operator==(const BlobRange&, const BlobRange&) = default;
};

/// Blobs that are among the dead and stay all the same, since somebody is about to refer to them: an import brings its
/// blobs before its rows. Only this process knows; after its end they are dead as others are. Thread-safe.
class KeptBlobs {
 public:
  /// `range` shares no key with those that are kept.
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
    std::int64_t next = 0;  // of no blob
    for (const BlobRange& range : ranges_) {
      if (next < range.first) others.push_back({next, range.first - 1});
      next = range.last + 1;  // keys are far from the last number there is
    }
    others.push_back({next, std::numeric_limits<std::int64_t>::max()});
    return others;
  }

 private:
  mutable Mutex mutex_;
  std::vector<BlobRange> ranges_ DHPMAP_GUARDED_BY(mutex_);  ///< by their keys
};

}  // namespace dhpmap

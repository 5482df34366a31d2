// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "mapping/base/mutex.h"
#include "mapping/map/map.h"
#include "mapping/surfaces/submap_index.h"

namespace dhpmap {

/// Indexes over the submaps of successive states of a map: each is derived from the last one, at the cost of a copy and
/// the changes. Does not keep states alive. Thread-safe; callers do not wait while others build one.
class IndexTrail {
 public:
  /// Refers to the state's submaps, which must outlive it. States may come in any order.
  std::shared_ptr<const SubmapIndex> Of(const MapSnapshot& state) DHPMAP_EXCLUDES(mutex_) {
    std::shared_ptr<const SubmapIndex> last;
    {
      const MutexLock lock(mutex_);
      last = last_;
    }
    auto made = last == nullptr ? std::make_shared<const SubmapIndex>(state.submaps())
                                : std::make_shared<const SubmapIndex>(*last, state.submaps());
    const MutexLock lock(mutex_);
    last_ = made;
    return made;
  }

 private:
  Mutex mutex_;
  /// Its submaps may be gone: only their positions are used.
  std::shared_ptr<const SubmapIndex> last_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "mapping/base/mutex.h"
#include "server/app/maps/map_summary.h"
#include "server/log/log.h"

namespace dhpmap {

/// Logs maps that the store cannot read, each once, when a list finds them. Thread-safe.
class DamagedMaps {
 public:
  void Tell(const MapSummary& map) DHPMAP_EXCLUDES(mutex_) {
    constexpr std::size_t kMost = 1000;
    {
      const MutexLock lock(mutex_);
      if (told_.size() >= kMost || !told_.insert(map.info.name).second) return;
    }
    LogError("map '" + map.info.name + "' cannot be served: " + map.damage.ToString());
  }

 private:
  Mutex mutex_;
  std::set<std::string> told_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stop_token>
#include <string>

#include "mapping/base/mutex.h"
#include "mapping/surfaces/surface_cache.h"
#include "server/app/open_map/lazy_thread.h"

namespace dhpmap {

/// Refreshes cached surfaces of queried maps while mapping changes them, ahead of the next query, on a thread that
/// exists only while there is work. Thread-safe.
class SurfaceKeeper {
 public:
  /// `cache` outlives this, or Stop().
  explicit SurfaceKeeper(SurfaceCache& cache) : cache_(cache) {}
  ~SurfaceKeeper() { Stop(); }
  SurfaceKeeper(const SurfaceKeeper&) = delete;
  SurfaceKeeper& operator=(const SurfaceKeeper&) = delete;

  /// Announces a new state of a map; it is pinned until its turn if the map is wanted. Returns at once whether it is.
  /// Calls ready(), which may be empty, when all is done, unless a newer state came first.
  bool Note(std::shared_ptr<const MapSnapshot> state, std::function<void()> ready = {}) DHPMAP_EXCLUDES(mutex_);
  /// Ends running work and ignores later states.
  void Stop() DHPMAP_EXCLUDES(mutex_);

 private:
  void Loop() DHPMAP_EXCLUDES(mutex_);

  SurfaceCache& cache_;
  std::stop_source stop_;
  Mutex mutex_;
  CondVar wake_;
  struct Noted {
    std::shared_ptr<const MapSnapshot> state;
    std::function<void()> ready;
  };
  std::map<std::string, Noted> newest_ DHPMAP_GUARDED_BY(mutex_);  ///< by map
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  LazyThread thread_;  // started under the mutex; joined only by Stop, after the last start
};

}  // namespace dhpmap

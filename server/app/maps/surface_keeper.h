// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stop_token>
#include <string>

#include "mapping/base/mutex.h"
#include "mapping/surfaces/surface_cache.h"
#include "server/app/session/lazy_thread.h"

namespace dhpmap {

/// While a map goes on and planners ask about it, makes again what they asked for lately, before they ask: on a thread
/// that is there only while there is something to do. Thread-safe.
class SurfaceKeeper {
 public:
  /// `cache` outlives this, or Stop().
  explicit SurfaceKeeper(SurfaceCache& cache) : cache_(cache) {}
  ~SurfaceKeeper() { Stop(); }
  SurfaceKeeper(const SurfaceKeeper&) = delete;
  SurfaceKeeper& operator=(const SurfaceKeeper&) = delete;

  /// That a map has a new state, which is kept until its turn if the map is wanted. Returns at once whether it is.
  /// ready(), which may be empty, is called when all is made, unless a newer one came before.
  bool Note(std::shared_ptr<const MapSnapshot> state, std::function<void()> ready = {}) DHPMAP_EXCLUDES(mutex_);
  /// Ends what is under way; later states are not noted.
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
  LazyThread thread_;  // begun under the mutex; joined by Stop alone, once nobody begins it any more
};

}  // namespace dhpmap

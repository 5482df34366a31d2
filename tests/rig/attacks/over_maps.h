// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <thread>

#include "mapping/base/mutex.h"
#include "tests/rig/server_under_test.h"

namespace dhpmap::rig {

/// What a server takes beside its maps (ServerUnderTest::MapsMib), as they are at that moment, at most while this
/// lives: looked at every 0.1 s. What has gone of maps, past states above all, counts for half a second more: the
/// allocator keeps free memory for a tenth of one before it gives it back. Thread-safe.
class OverMapsWatch {
 public:
  /// `server` outlives it.
  explicit OverMapsWatch(ServerUnderTest& server);

  /// The most, and what made it up.
  struct Look {
    double resident_mib = 0, maps_mib = 0;
    [[nodiscard]] double over_mib() const { return resident_mib - maps_mib; }
  };
  [[nodiscard]] Look most() const DHPMAP_EXCLUDES(mutex_);
  /// From here on only.
  void Reset() DHPMAP_EXCLUDES(mutex_);

 private:
  void Note(const Look& look) DHPMAP_EXCLUDES(mutex_);

  mutable Mutex mutex_;
  Look most_ DHPMAP_GUARDED_BY(mutex_);
  std::jthread thread_;  // last: reads the others
};

/// Whether that stays within the budget for requests and answers and what may come beside it; prints it.
bool ExpectBesideMaps(const OverMapsWatch::Look& look);

}  // namespace dhpmap::rig

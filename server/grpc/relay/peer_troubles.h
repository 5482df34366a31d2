// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// Logs why other servers of the fleet cannot be reached: at most one line for an address in ten seconds, not one a
/// call. Thread-safe.
class PeerTroubles {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPause{10};
  static constexpr std::size_t kMostPeers = 64;  ///< all further ones count as one

  /// `now` is for tests; empty: the steady clock.
  explicit PeerTroubles(std::function<Clock::time_point()> now = {});

  /// A call to `address` failed; `why`: gRPC's words.
  void Note(const std::string& address, const std::string& why) DHPMAP_EXCLUDES(mutex_);

 private:
  const std::function<Clock::time_point()> now_;
  Mutex mutex_;
  std::map<std::string, Clock::time_point> logged_at_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "mapping/base/mutex.h"
#include "mapping/base/status.h"

namespace dhpmap::auth {

/// Monotonic time in s, independent of the system's clock. Injected, so that tests control it.
using PassingTime = std::function<double()>;
PassingTime SystemPassingTime();

/// Limits of one principal, over all its keys.
struct CallLimits {
  double calls_per_s = 2000;
  double burst_calls = 4000;
  int streams = 64;
  int feeds = 4;                                     ///< of the streams
  int maps = 100;                                    ///< that it has created
  std::int64_t disk_bytes = std::int64_t{64} << 30;  ///< of these maps, as stored
  double inflight_fraction = 0.5;                    ///< of the bytes that all principals together may have in flight
};

/// Limits the call rate of each principal by a token bucket. Thread-safe. Holds a bucket for each principal that has
/// called, so at most one per key.
class CallRates {
 public:
  CallRates(const CallLimits& limits, PassingTime now_s) : limits_(limits), now_s_(std::move(now_s)) {}

  /// Counts one call. RESOURCE_EXHAUSTED, reason OUT_OF_QUOTA, if the principal exceeds its rate.
  Status Count(std::string_view principal) DHPMAP_EXCLUDES(mutex_);

 private:
  struct Bucket {
    double left = 0;
    double filled_s = 0;
  };

  const CallLimits limits_;
  const PassingTime now_s_;
  Mutex mutex_;
  std::map<std::string, Bucket, std::less<>> buckets_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::auth

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpc/support/time.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace dhpmap::client {

using Clock = std::chrono::steady_clock;

/// Seconds as a duration of the steady clock; at most a year, so that sums do not overflow.
inline Clock::duration Seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::clamp(s, 0.0, 3.2e7)));
}

/// A time of the steady clock, for gRPC.
inline gpr_timespec GrpcTime(Clock::time_point end) {
  const auto left = std::chrono::duration_cast<std::chrono::microseconds>(end - Clock::now()).count();
  return gpr_time_add(gpr_now(GPR_CLOCK_MONOTONIC),
                      gpr_time_from_micros(std::max<std::int64_t>(left, 0), GPR_TIMESPAN));
}

/// Pauses between retries: each longer than the last, up to 2 s.
class Pauses {
 public:
  Clock::duration Next() {
    const Clock::duration pause = next_;
    next_ = std::min<Clock::duration>(2 * next_, std::chrono::seconds(2));
    return pause;
  }

 private:
  Clock::duration next_ = std::chrono::milliseconds(100);
};

}  // namespace dhpmap::client

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

namespace dhpmap {

/// A deadline of the steady clock.
using DueTime = std::chrono::steady_clock::time_point;

/// `seconds` from now: at least 0, at most years.
inline DueTime DueIn(double seconds) {
  using Clock = std::chrono::steady_clock;
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// ns since 1970, UTC.
using UtcClock = std::function<std::int64_t()>;

}  // namespace dhpmap

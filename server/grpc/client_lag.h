// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace dhpmap {

/// How far a client that brings a file is behind the least rate. Time that is waited for it counts, but for what its
/// bytes pay for: who sends a byte now and then is silent. Thread-compatible.
class ClientLag {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kLeast_bytes_per_s = 16 << 10;

  /// Its next part is waited for.
  void Wait(Clock::time_point now) { since_ = now; }
  /// That has come.
  void Hear(std::size_t num_bytes, Clock::time_point now) {
    const std::chrono::duration<double> paid_for(static_cast<double>(num_bytes) / kLeast_bytes_per_s);
    behind_ = WhileWaiting(now);
    behind_ -= std::min(behind_, std::chrono::duration_cast<Clock::duration>(paid_for));
  }
  /// While a part is waited for.
  [[nodiscard]] Clock::duration WhileWaiting(Clock::time_point now) const { return behind_ + (now - since_); }

 private:
  Clock::time_point since_;
  Clock::duration behind_{};  ///< without the present wait
};

}  // namespace dhpmap

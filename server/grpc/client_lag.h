// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace dhpmap {

/// How far a client that uploads a file is behind the minimum rate. Only time spent waiting for the client counts, and
/// each received byte pays off part of it. So a client that sends one byte now and then counts as silent.
/// Thread-compatible.
class ClientLag {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kLeast_bytes_per_s = 16 << 10;

  /// The server waits for the next part.
  void Wait(Clock::time_point now) { since_ = now; }
  /// The part has arrived.
  void Hear(std::size_t num_bytes, Clock::time_point now) {
    const std::chrono::duration<double> paid_for(static_cast<double>(num_bytes) / kLeast_bytes_per_s);
    behind_ = WhileWaiting(now);
    behind_ -= std::min(behind_, std::chrono::duration_cast<Clock::duration>(paid_for));
  }
  /// The lag at `now`, while the server waits for a part.
  [[nodiscard]] Clock::duration WhileWaiting(Clock::time_point now) const { return behind_ + (now - since_); }

 private:
  Clock::time_point since_;
  Clock::duration behind_{};  ///< without the wait in progress
};

}  // namespace dhpmap

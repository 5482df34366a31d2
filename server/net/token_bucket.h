// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>

namespace dhpmap::net {

/// A token bucket: a burst, and a sustained rate. Thread-compatible; the caller supplies the time.
class TokenBucket {
 public:
  using Time = std::chrono::steady_clock::time_point;

  constexpr TokenBucket(double burst, double per_s) : burst_(burst), per_s_(per_s), tokens_(burst) {}

  /// Takes a token; false if none is left.
  bool Take(Time now) {
    Fill(now);
    if (tokens_ < 1) return false;
    tokens_ -= 1;
    return true;
  }
  void Fill(Time now) {
    if (now <= at_) return;
    if (at_ != Time()) tokens_ = std::min(burst_, tokens_ + per_s_ * std::chrono::duration<double>(now - at_).count());
    at_ = now;
  }
  /// State at the last Take or Fill.
  [[nodiscard]] bool has_given(double tokens) const { return tokens_ < burst_ - tokens; }
  [[nodiscard]] bool is_half_empty() const { return tokens_ < burst_ / 2; }
  [[nodiscard]] bool is_full() const { return tokens_ >= burst_; }

 private:
  double burst_, per_s_, tokens_;
  Time at_{};
};

}  // namespace dhpmap::net

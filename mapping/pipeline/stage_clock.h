// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace dhpmap {

/// Adds the wall time of its own life to a sum of seconds.
class StageClock {
 public:
  explicit StageClock(double& sum_s) : sum_s_(sum_s) {}
  ~StageClock() { sum_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

 private:
  double& sum_s_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace dhpmap

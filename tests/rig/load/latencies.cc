// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/load/latencies.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dhpmap::rig {

void Latencies::Add(double seconds) {
  const MutexLock lock(mutex_);
  seconds_.push_back(seconds);
}

void Latencies::AddFailure() {
  const MutexLock lock(mutex_);
  ++num_failures_;
}

double Latencies::Percentile_s(double share) const {
  std::vector<double> sorted;
  {
    const MutexLock lock(mutex_);
    sorted = seconds_;
  }
  if (sorted.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, sorted.size()) - 1);
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

int Latencies::num_failures() const {
  const MutexLock lock(mutex_);
  return num_failures_;
}

std::string Latencies::Summary() const {
  std::size_t count = 0;
  {
    const MutexLock lock(mutex_);
    count = seconds_.size();
  }
  char text[160];
  std::snprintf(text, sizeof text, "%zu times: median %.2f, p99 %.2f, p99.9 %.2f, most %.2f ms; %d failed", count,
                1e3 * Percentile_s(0.5), 1e3 * Percentile_s(0.99), 1e3 * Percentile_s(0.999), 1e3 * Percentile_s(1),
                num_failures());
  return text;
}

}  // namespace dhpmap::rig

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mapping/base/mutex.h"

namespace dhpmap::rig {

/// How long something took, many times over. Thread-safe.
class Latencies {
 public:
  void Add(double seconds) DHPMAP_EXCLUDES(mutex_);
  void AddFailure() DHPMAP_EXCLUDES(mutex_);

  /// The least value that `share` (0..1) of them do not exceed, s; 0 if there is none.
  [[nodiscard]] double Percentile_s(double share) const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] int num_failures() const DHPMAP_EXCLUDES(mutex_);
  /// "12,345 times: median 0.4, p99 3.1, p99.9 8.0, most 12.3 ms; 0 failed".
  [[nodiscard]] std::string Summary() const DHPMAP_EXCLUDES(mutex_);

 private:
  mutable Mutex mutex_;
  std::vector<double> seconds_ DHPMAP_GUARDED_BY(mutex_);
  int num_failures_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap::rig

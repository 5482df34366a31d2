// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>
#include <thread>

#include "mapping/base/mutex.h"

namespace dhpmap::rig {

/// What a process takes of the machine.
struct ProcessUse {
  double resident_mib = 0, anonymous_mib = 0;
  int num_threads = 0;  ///< but gRPC's own
  int num_files = 0;
};
ProcessUse UseOf(pid_t pid);
/// Its resident memory alone, which takes some microseconds.
double ResidentMib(pid_t pid);

/// A server's /metrics; empty if it does not answer.
std::string MetricsOf(int http_port);
/// A gauge or counter of them, summed over its labels; 0 if it is not there.
double Metric(const std::string& metrics, const std::string& name);

/// The most that a process takes while this lives, looked at every 50 ms. Thread-safe.
class PeakWatch {
 public:
  explicit PeakWatch(pid_t pid);
  ~PeakWatch() = default;
  PeakWatch(const PeakWatch&) = delete;
  PeakWatch& operator=(const PeakWatch&) = delete;

  [[nodiscard]] ProcessUse peak() const DHPMAP_EXCLUDES(mutex_);
  /// From here on only.
  void Reset() DHPMAP_EXCLUDES(mutex_);

 private:
  mutable Mutex mutex_;
  ProcessUse peak_ DHPMAP_GUARDED_BY(mutex_);
  std::jthread thread_;  // last: reads the others
};

}  // namespace dhpmap::rig

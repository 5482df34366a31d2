// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/service/lane_pulse.h"

namespace dhpmap::service {

/// What WATCHDOG_USEC says: the manager ends a service that has not said for so long that it is alive. Nothing without
/// it, if it is for another process (WATCHDOG_PID), or is no number above 0.
std::optional<std::chrono::microseconds> WatchdogTime(const std::vector<std::string>& environment, int pid);

/// Lets a pulse beat on a thread of its own, three times in the manager's time: one that waits behind a burst of calls
/// is late, and nobody ends the server for it.
class Watchdog {
 public:
  Watchdog(std::chrono::microseconds time, LanePulse pulse);
  /// Lets it beat no more.
  ~Watchdog();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::service

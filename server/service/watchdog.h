// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/service/lane_pulse.h"

namespace dhpmap::service {

/// The time in WATCHDOG_USEC: the manager ends a service that is silent for so long. Nothing if the variable is
/// missing, for another process (WATCHDOG_PID), or not a positive number.
std::optional<std::chrono::microseconds> WatchdogTime(const std::vector<std::string>& environment, int pid);

/// Beats a pulse on its own thread, three times in the manager's time, so that a beat delayed by a burst of calls does
/// not end the server.
class Watchdog {
 public:
  Watchdog(std::chrono::microseconds time, LanePulse pulse);
  /// Stops the beats.
  ~Watchdog();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::service

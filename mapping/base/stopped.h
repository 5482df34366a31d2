// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <stop_token>

namespace dhpmap {

/// Thrown by long work after a stop request: through the thread pool, to code that can roll back.
class Stopped final : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "told to stop"; }
};

/// Costs a nanosecond: for loops whose turns take microseconds.
inline void ThrowIfStopped(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped();
}

}  // namespace dhpmap

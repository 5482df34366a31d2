// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace dhpmap::testing {

/// A time that only what hangs needs, in a sanitizer's build on a busy machine, too.
inline constexpr std::chrono::minutes kPatience{3};

/// Waits until it holds; false after kPatience. Sleeps between looks: who spins keeps a core from the nice threads that
/// it may be waiting for.
inline bool Eventually(const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!holds()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace dhpmap::testing

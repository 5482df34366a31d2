// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <system_error>
#include <thread>

#include "mapping/base/status.h"

namespace dhpmap {

/// A thread that starts on demand and may end when idle: a thousand unchanged maps need none. Thread-compatible: its
/// users hold a mutex.
class LazyThread {
 public:
  /// How long a loop waits for more work before it retires.
  static constexpr std::chrono::milliseconds kIdle{500};

  /// RESOURCE_EXHAUSTED if the system cannot start a thread; the next call tries again.
  Status Start(std::function<void()> loop) {
    if (is_running_) return Status::Ok();
    Join();  // a retired thread: it no longer waits for anything
    try {
      thread_ = std::thread(std::move(loop));
      is_running_ = has_run_ = true;
    } catch (const std::system_error&) {
      return ResourceExhausted("the system has no thread for this map: try again later").WithReason("TOO_BUSY");
    }
    return Status::Ok();
  }
  /// Last call of the loop before it unlocks the mutex: the next Start begins another thread.
  void Retire() { is_running_ = false; }
  /// Waits for its end, if it was started.
  void Join() {
    if (thread_.joinable()) thread_.join();
    is_running_ = false;
  }
  /// Whether it was ever started.
  [[nodiscard]] bool has_run() const { return has_run_; }

 private:
  std::thread thread_;
  bool is_running_ = false, has_run_ = false;
};

}  // namespace dhpmap

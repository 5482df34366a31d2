// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <system_error>
#include <thread>

#include "mapping/base/status.h"

namespace dhpmap {

/// A thread that begins when it is first needed: of a thousand maps that are only read, none has one.
/// Thread-compatible.
class LazyThread {
 public:
  /// RESOURCE_EXHAUSTED if the system gives no thread; the next call tries again.
  Status Start(std::function<void()> loop) {
    if (thread_.joinable()) return Status::Ok();
    try {
      thread_ = std::thread(std::move(loop));
    } catch (const std::system_error&) {
      return ResourceExhausted("the system has no thread for this map: try again later").WithReason("TOO_BUSY");
    }
    return Status::Ok();
  }
  /// Waits for its end, if it has begun.
  void Join() {
    if (thread_.joinable()) thread_.join();
  }

 private:
  std::thread thread_;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "server/grpc/call_runner.h"

namespace dhpmap {

/// Calls that wait until a map is at some revision. None holds a thread: each looks again every 10 ms. Thread-safe.
class RevisionWaits {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kLongest{10};
  static constexpr int kMost = 256;

  explicit RevisionWaits(const ServiceContext& context) : context_(context) {}

  /// What a call waits for.
  struct Wanted {
    std::string map;
    std::int64_t revision = 0;
    bool is_eventual = false;  ///< of the state that MapRegistry::EventualViewOf gives, in place of ViewOf
  };

  /// Calls done(OK) on the quick lane once the map is at the revision or later; else done() with why it is not: what
  /// MapRegistry::ViewOf says, OUT_OF_RANGE, reason HISTORY_LOST, for a revision that was lost with a crash,
  /// DEADLINE_EXCEEDED after `deadline` or kLongest, CANCELLED soon after `stop` is requested, RESOURCE_EXHAUSTED if
  /// kMost wait already. To be called on the quick lane; `done` may run before it returns. The context outlives the
  /// wait.
  void Await(Wanted wanted, TimePoint deadline, std::stop_token stop, std::function<void(const Status&)> done);

 private:
  class Wait;

  const ServiceContext& context_;
  const std::shared_ptr<std::atomic<int>> num_waiting_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace dhpmap

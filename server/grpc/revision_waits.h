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

/// Calls that wait for a revision of a map. A waiting call holds no thread; it checks every 10 ms. Thread-safe.
class RevisionWaits {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kLongest{10};
  static constexpr int kMost = 256;

  explicit RevisionWaits(const ServiceContext& context) : context_(context) {}

  /// The map and revision that a call waits for.
  struct Wanted {
    std::string map;
    std::int64_t revision = 0;
    bool is_eventual = false;  ///< use MapRegistry::EventualViewOf in place of ViewOf
  };

  /// Calls done(OK) on the quick lane once the map has reached the revision. Else calls done() with the error: one of
  /// MapRegistry::ViewOf; OUT_OF_RANGE, reason HISTORY_LOST, for a revision lost in a crash; DEADLINE_EXCEEDED after
  /// `deadline` or kLongest; CANCELLED soon after `stop` is requested; RESOURCE_EXHAUSTED if kMost calls wait already.
  /// Call it on the quick lane; `done` may run before it returns. The context outlives the wait.
  void Await(Wanted wanted, TimePoint deadline, std::stop_token stop, std::function<void(const Status&)> done);

 private:
  class Wait;

  const ServiceContext& context_;
  const std::shared_ptr<std::atomic<int>> num_waiting_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace dhpmap

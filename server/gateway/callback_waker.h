// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

namespace dhpmap::gateway {

/// Keeps gRPC's callback threads awake while it lives. On this platform gRPC 1.51 runs all callbacks of a process,
/// server and client, on a few threads. After a second without events they sleep for 100 ms at a time (its
/// completion_queue_cc.cc, "idle phase"): 4 of 15 calls on an idle server took 31 to 88 ms instead of 0.5. A small
/// event every few hundred milliseconds keeps at least one of them awake. Thread-safe.
class CallbackWaker {
 public:
  explicit CallbackWaker(std::chrono::milliseconds period = std::chrono::milliseconds(400));
  /// Waits for the current event, not for the next.
  ~CallbackWaker();

  /// Number of events that a callback thread has run.
  [[nodiscard]] std::int64_t num_events() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::gateway

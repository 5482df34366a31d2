// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

namespace dhpmap::gateway {

/// Keeps gRPC's callback threads from dozing off while it lives. On this platform gRPC 1.51 runs all callbacks of a
/// process, the server's and the client's, on a few threads that sleep 100 ms at a stretch after a second without
/// events (its completion_queue_cc.cc, "idle phase"): measured, 4 of 15 calls on an idle server took 31 to 88 ms
/// instead of 0.5. One small event every few hundred milliseconds keeps at least one of them awake. Thread-safe.
class CallbackWaker {
 public:
  explicit CallbackWaker(std::chrono::milliseconds period = std::chrono::milliseconds(400));
  /// Waits for the event under way, not for the next.
  ~CallbackWaker();

  /// So many have been through a callback thread.
  [[nodiscard]] std::int64_t num_events() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::gateway

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "server/net/client_socket.h"
#include "server/net/frame_limits.h"
#include "server/net/refusal.h"

namespace dhpmap::net {

/// Runs connections on a thread of its own, each having its share. Thread-safe.
class Relay {
 public:
  /// A connection has ended: its number, and why if it was ended for what it did. On the thread.
  using OnEnded = std::function<void(std::uint64_t number, Refusal why)>;

  explicit Relay(OnEnded on_ended);
  /// Ends those that are left.
  ~Relay();

  void Add(std::uint64_t number, ClientSocket client, Descriptor inner, std::unique_ptr<FrameLimits> limits);
  /// Returns when all have ended, or after so long. For when the doors behind have closed.
  void WaitUntilEmpty(std::chrono::duration<double> at_most);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::net

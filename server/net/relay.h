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

/// Forwards the bytes of connections on one thread, with a fair share for each. Thread-safe.
class Relay {
 public:
  /// A connection has ended: its number, and the reason if a limit ended it. Called on the thread.
  using OnEnded = std::function<void(std::uint64_t number, Refusal why)>;

  explicit Relay(OnEnded on_ended);
  /// Ends the remaining connections.
  ~Relay();

  void Add(std::uint64_t number, ClientSocket client, Descriptor inner, std::unique_ptr<FrameLimits> limits);
  /// Returns when all have ended, or after `at_most`. Call after the server behind the door has closed.
  void WaitUntilEmpty(std::chrono::duration<double> at_most);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dhpmap::net

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/epoll.h>

#include <array>
#include <cstdint>
#include <span>

#include "server/net/descriptor.h"

namespace dhpmap::net {

/// Level-triggered epoll with a wake-up event. Thread-compatible; Wake is thread-safe.
class Poller {
 public:
  struct Ready {
    int descriptor;
    std::uint32_t events;
  };

  Poller();

  /// False if the system is out of resources.
  bool Add(int descriptor, std::uint32_t events);
  void Change(int descriptor, std::uint32_t events);
  void Remove(int descriptor);
  /// Returns the ready descriptors; none after `wait_ms` (-1: no timeout) or Wake.
  std::span<const Ready> Wait(int wait_ms);
  /// Ends the current Wait, or the next one. Thread-safe.
  void Wake();

 private:
  Descriptor epoll_, bell_;
  std::array<epoll_event, 64> events_{};
  std::array<Ready, 64> ready_{};
};

}  // namespace dhpmap::net

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "tests/rig/clients/corridor.h"

namespace dhpmap::rig {

/// Where the servers are now. Thread-safe.
class Doors {
 public:
  explicit Doors(std::size_t num_servers) : num_servers_(num_servers), channels_(num_servers) {}
  void Set(std::size_t server, const std::string& address) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::shared_ptr<grpc::Channel> ChannelTo(std::size_t server) const DHPMAP_EXCLUDES(mutex_);
  /// The one at that address; `otherwise` if there is none, or no longer.
  [[nodiscard]] std::size_t Find(const std::string& address, std::size_t otherwise) const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t size() const { return num_servers_; }

 private:
  struct Door {
    std::string address;
    std::shared_ptr<grpc::Channel> channel;
  };
  const std::size_t num_servers_;
  mutable Mutex mutex_;
  std::vector<Door> channels_ DHPMAP_GUARDED_BY(mutex_);
};

/// A robot that feeds a map of its own at an even pace, each frame until it is acknowledged as stored: sequences 1, 2,
/// and so on. It goes where NOT_OWNER sends it, and to the next server when one does not answer in time.
class PacedRobot {
 public:
  using Clock = std::chrono::steady_clock;

  PacedRobot(const Doors& doors, const Corridor& corridor, std::string map, std::size_t server)
      : doors_(doors), corridor_(corridor), map_(std::move(map)), server_(server) {}

  /// Until it is told to stop.
  void Run(double period_s, double timeout_s, const std::atomic<bool>& is_over);

  struct Acknowledged {
    std::int64_t sequence = 0;
    Clock::time_point time;
    std::size_t server = 0;
  };
  [[nodiscard]] std::vector<Acknowledged> acknowledged() const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] const std::string& map() const { return map_; }
  [[nodiscard]] int num_sent_on() const { return num_sent_on_; }
  [[nodiscard]] int num_failed() const { return num_failed_; }
  /// Reasons of refusals that nobody expects.
  [[nodiscard]] std::vector<std::string> complaints() const DHPMAP_EXCLUDES(mutex_);

 private:
  /// Whether it is stored; else where to go next is noted.
  bool Send(std::int64_t sequence, double timeout_s);

  const Doors& doors_;
  const Corridor& corridor_;
  const std::string map_;
  std::size_t server_;
  std::atomic<int> num_sent_on_ = 0, num_failed_ = 0;
  mutable Mutex mutex_;
  std::vector<Acknowledged> acknowledged_ DHPMAP_GUARDED_BY(mutex_);
  std::vector<std::string> complaints_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::rig

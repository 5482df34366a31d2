// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "dhpmap/v1/map_service.pb.h"
#include "mapping/base/mutex.h"

namespace dhpmap::rig {

/// One watch of each of some maps, on one server, some watches a connection. Thread-safe.
class WatchedMaps {
 public:
  using Clock = std::chrono::steady_clock;

  /// Watches each map from its present revision on.
  WatchedMaps(const std::string& address, const std::vector<v1::Map>& maps);
  /// Ends the watches.
  ~WatchedMaps();
  WatchedMaps(const WatchedMaps&) = delete;
  WatchedMaps& operator=(const WatchedMaps&) = delete;

  /// Blocks until the watch of map number `map` has reported `revision`. False after `patience_s`, or if it ended.
  bool WaitFor(std::size_t map, std::int64_t revision, double patience_s) DHPMAP_EXCLUDES(mutex_);
  /// When it reported that revision, or a later one.
  [[nodiscard]] Clock::time_point TimeOf(std::size_t map, std::int64_t revision) const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] int num_ended() const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Report {
    std::int64_t revision = 0;
    Clock::time_point time;
  };
  void Read(std::size_t map, const std::shared_ptr<grpc::Channel>& channel, const v1::Map& from)
      DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] const Report* Find(std::size_t map, std::int64_t revision) const DHPMAP_REQUIRES(mutex_);

  mutable Mutex mutex_;
  CondVar changed_;
  std::vector<std::vector<Report>> reports_ DHPMAP_GUARDED_BY(mutex_);  // by map, in order
  int num_ended_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::vector<std::unique_ptr<grpc::ClientContext>> contexts_;
  std::vector<std::thread> threads_;
};

}  // namespace dhpmap::rig

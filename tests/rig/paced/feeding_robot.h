// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "tests/rig/clients/corridor.h"

namespace dhpmap::rig {

/// A robot that feeds a map of its own at an even pace through one stream, as robots do. It never sends a frame again.
class FeedingRobot {
 public:
  /// `corridor` outlives it.
  FeedingRobot(std::shared_ptr<grpc::Channel> channel, const Corridor& corridor, std::string map)
      : channel_(std::move(channel)), corridor_(corridor), map_(std::move(map)) {}

  /// Sends frames from `first` on, one each `period_s`, until `is_over`; then waits until the server has stored them.
  void Run(std::chrono::steady_clock::time_point first, double period_s, const std::atomic<bool>& is_over);

  /// Frames that the server has fused so far. Thread-safe.
  [[nodiscard]] std::int64_t num_fused() const { return num_fused_; }
  /// After Run: empty, or why not all frames are stored.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }
  [[nodiscard]] std::int64_t num_sent() const { return num_sent_; }

 private:
  const std::shared_ptr<grpc::Channel> channel_;
  const Corridor& corridor_;
  const std::string map_;
  std::atomic<std::int64_t> num_fused_ = 0;
  std::int64_t num_sent_ = 0;
  std::string complaint_;
};

}  // namespace dhpmap::rig

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <string>
#include <thread>

#include "tests/rig/load/latencies.h"

namespace dhpmap::rig {

/// GetSubmap and /healthz beside whatever else goes on, each every 20 ms while this lives. Thread-compatible.
class QuickProbes {
 public:
  /// Of submap 1 of the map. `channel` should be connected.
  QuickProbes(const std::shared_ptr<grpc::Channel>& channel, int http_port, const std::string& map_id);

  /// Ends them.
  void Stop();
  /// Prints what they took.
  void Tell() const;
  /// Prints p99 of each, and whether it is within what the server promises. Those that failed are not in it.
  [[nodiscard]] bool Held() const;
  [[nodiscard]] int num_failures() const;
  /// The greater of the two p99, ms.
  [[nodiscard]] double WorstP99_ms() const;

 private:
  Latencies get_submap_, health_;
  std::jthread submaps_, healths_;  // last: they write to the others
};

}  // namespace dhpmap::rig

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "tests/rig/load/bulk_calls.h"
#include "tests/rig/load/latencies.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {

/// What a planner asks of the apartment of dhpmap-simulate, and a person's edits of it; of all kinds, some of each.
/// Thread-compatible; each has connections of its own.
class PlannerCalls {
 public:
  static constexpr std::array kKinds = {
      "QueryPoints, 100",         "QueryDistances, 100",      "CastRays, 100",         "CheckCollisions, 100",
      "CheckTrajectory, 50 x 20", "QueryOccupancySlice, 2 m", "QueryDistanceGrid",     "SearchSubmaps",
      "QueryRelations",           "StreamQueries, pinned",    "QueryPoints over REST", "four edits"};
  /// How long each kind took, together with those of other clients.
  using Table = std::array<Latencies, kKinds.size()>;

  PlannerCalls(const Target& target, unsigned seed);

  /// One after the other at random, what steers a robot most often, `rate_hz` a second at most, until stopped.
  void Run(double rate_hz, Table& table, const std::stop_token& stop);
  /// What went wrong, at most 10 of them.
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  bool Points();
  bool Distances();
  bool Rays();
  bool Collisions();
  bool Trajectory();
  bool Slice();
  bool Grid();
  bool Search();
  bool Relations();
  bool Stream();
  bool PointsOverRest();
  bool Edits();

  /// An answer as it should be: OK, as many parts as were asked for, and of no older revision than the one before.
  bool IsRight(const grpc::Status& status, std::int64_t revision, int num_answered, int num_asked);
  bool Complain(const std::string& what);
  double Any(double most) { return std::uniform_real_distribution<double>(0, most)(random_); }
  template <typename Request>
  void AddPlaces(Request& request, int number);
  v1::Vector3 Place();

  const Target target_;
  const testing::Client client_;
  http::HttpClient http_;
  std::mt19937 random_;
  std::int64_t revision_ = 0;  ///< of the last answer
  std::vector<std::string> complaints_;
};

}  // namespace dhpmap::rig

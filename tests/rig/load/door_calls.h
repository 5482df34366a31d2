// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "dhpmap/v1/query_service.grpc.pb.h"
#include "tests/rig/load/bulk_calls.h"
#include "tests/rig/load/latencies.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {

/// What a planner asks a hundred points of, through each door, one call after the other on connections of its own.
/// Thread-compatible.
class DoorCalls {
 public:
  static constexpr int kPoints = 100;
  static constexpr std::array kKinds = {
      "gRPC, QueryPoints",         "gRPC, QueryDistances",         "gRPC, QueryDistances to 0.5 voxel",
      "REST, QueryPoints as JSON", "REST, QueryDistances as JSON", "REST, QueryDistances as protobuf"};
  /// How long each took, from the request to the last byte of the answer; what makes and reads messages of JSON on the
  /// client's side is not in it.
  using Table = std::array<Latencies, kKinds.size()>;

  DoorCalls(const Target& target, unsigned seed);

  /// All kinds in turn, `rate_hz` calls a second at most (0: as fast as they are answered), until stopped.
  void Run(double rate_hz, Table& table, const std::stop_token& stop);
  /// What went wrong, at most 10 of them.
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  using Seconds = std::optional<double>;  ///< nothing: it was not answered as it should be
  Seconds PointsOverGrpc();
  Seconds DistancesOverGrpc(double tolerance_vox);
  Seconds PointsAsJson();
  Seconds DistancesAsJson();
  Seconds DistancesAsProtobuf();

  /// Around one place of the apartment.
  template <typename Request>
  Request About();
  template <typename Response, typename Request>
  Seconds AskInJson(const std::string& method, const Request& request, Response& answer);
  bool IsRight(std::int64_t revision, int num_answered);
  Seconds Complain(const std::string& what);
  double Any(double most) { return std::uniform_real_distribution<double>(0, most)(random_); }

  const Target target_;
  const std::shared_ptr<grpc::Channel> channel_;
  const std::unique_ptr<v1::QueryService::Stub> queries_;
  http::HttpClient http_;
  std::mt19937 random_;
  std::int64_t revision_ = 0;  ///< of the last answer
  std::vector<std::string> complaints_;
};

}  // namespace dhpmap::rig

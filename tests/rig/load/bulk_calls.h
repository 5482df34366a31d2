// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "tests/support/client.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::rig {

/// Where a server is, and which of its maps is asked for.
struct Target {
  std::string grpc_address;  ///< host:port
  int http_port = 0;         ///< on 127.0.0.1
  std::string map_id;
};

/// What takes a server long to answer. Thread-compatible; each has a connection of its own.
class BulkCalls {
 public:
  explicit BulkCalls(const Target& target);

  /// Each returns whether the server answered as it should; REST and gRPC may refuse for want of room, which is well.
  bool WholeMesh();
  bool AbandonedMesh();  ///< hangs up after the first part
  bool ManyPoints(int num_points);
  bool ManyPointsAsJson(int num_points);
  bool Voxels(std::int64_t submap);
  bool MeshOverRest();

  /// One after the other, from the `first` on, until stopped.
  void Run(int first, const std::stop_token& stop);
  [[nodiscard]] int num_calls() const { return num_calls_; }
  [[nodiscard]] int num_failures() const { return num_failures_; }
  /// How many failed in which way.
  [[nodiscard]] const std::map<std::string, int>& failures() const { return failures_; }

 private:
  /// Returns whether it is an answer; else notes what of.
  bool Answered(const char* call, const grpc::Status& status);
  bool Answered(const char* call, const http::HttpAnswer& answer);

  Target target_;
  testing::Client client_;
  int num_calls_ = 0, num_failures_ = 0;
  std::map<std::string, int> failures_;
};

/// A connection that no other channel shares.
std::shared_ptr<grpc::Channel> OwnChannel(const std::string& address);
/// Points all over the apartment of dhpmap-simulate, 0..11 x 0..8 x 0..2.6 m.
v1::QueryPointsRequest PointsEverywhere(const std::string& map_id, int num_points);
/// True for OK, and for what a server says that has no room just now.
bool IsAnswer(const grpc::Status& status);

}  // namespace dhpmap::rig

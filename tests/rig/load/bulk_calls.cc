// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/load/bulk_calls.h"

#include <cstdio>
#include <limits>

namespace dhpmap::rig {
namespace {

constexpr int kMuch = 500'000, kMuchAsJson = 50'000;

/// Coordinates that cover the range evenly, without a random generator.
float Spread(int i, double step, double range_m) {
  const double turns = i * step;
  return static_cast<float>((turns - static_cast<double>(static_cast<std::int64_t>(turns))) * range_m);
}

}  // namespace

std::shared_ptr<grpc::Channel> OwnChannel(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // else all channels to an address share one connection
  arguments.SetMaxReceiveMessageSize(std::numeric_limits<int>::max());
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

bool IsAnswer(const grpc::Status& status) {
  return status.ok() || status.error_code() == grpc::StatusCode::RESOURCE_EXHAUSTED;
}

v1::QueryPointsRequest PointsEverywhere(const std::string& map_id, int num_points) {
  v1::QueryPointsRequest request;
  request.set_map("maps/" + map_id);
  request.set_packed(true);
  request.mutable_packed_points_m()->Reserve(3 * num_points);
  for (int i = 0; i < num_points; ++i) {
    request.add_packed_points_m(Spread(i, 0.7548776662466927, 11));
    request.add_packed_points_m(Spread(i, 0.5698402909980532, 8));
    request.add_packed_points_m(Spread(i, 0.3247179572447460, 2.6));
  }
  return request;
}

BulkCalls::BulkCalls(const Target& target) : target_(target), client_(OwnChannel(target.grpc_address)) {}

bool BulkCalls::Answered(const char* call, const grpc::Status& status) {
  if (IsAnswer(status)) return true;
  ++failures_[std::string(call) + ": " + std::to_string(status.error_code()) + " " + status.error_message()];
  return false;
}

bool BulkCalls::Answered(const char* call, const http::HttpAnswer& answer) {
  if ((answer.status == 200 && answer.is_complete) || answer.status == 429 || answer.status == 503) return true;
  ++failures_[std::string(call) + ": " + std::to_string(answer.status) + (answer.is_complete ? "" : ", cut off")];
  return false;
}

bool BulkCalls::WholeMesh() {
  grpc::ClientContext context;
  v1::GetSubmapMeshRequest request;
  request.set_name("maps/" + target_.map_id);
  const auto mesh = testing::SubmapStub(client_.channel()).GetSubmapMesh(&context, request);
  v1::GetSubmapMeshResponse part;
  while (mesh->Read(&part)) {
  }
  return Answered("mesh", mesh->Finish());
}

bool BulkCalls::AbandonedMesh() {
  grpc::ClientContext context;
  v1::GetSubmapMeshRequest request;
  request.set_name("maps/" + target_.map_id);
  const auto mesh = testing::SubmapStub(client_.channel()).GetSubmapMesh(&context, request);
  v1::GetSubmapMeshResponse part;
  (void)mesh->Read(&part);
  context.TryCancel();
  while (mesh->Read(&part)) {
  }
  const grpc::Status status = mesh->Finish();
  return status.error_code() == grpc::StatusCode::CANCELLED || Answered("abandoned mesh", status);
}

bool BulkCalls::ManyPoints(int num_points) {
  const v1::QueryPointsRequest points = PointsEverywhere(target_.map_id, num_points);
  return Answered("points", client_.Call(&testing::QueryStub::QueryPoints, points).status());
}

bool BulkCalls::ManyPointsAsJson(int num_points) {
  const v1::QueryPointsRequest points = PointsEverywhere(target_.map_id, num_points);
  std::string body = "{\"packed\": true, \"packed_points_m\": [";
  for (int i = 0; i < points.packed_points_m_size(); ++i) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.4f", i == 0 ? "" : ",", static_cast<double>(points.packed_points_m(i)));
    body += number;
  }
  body += "]}";
  http::HttpClient client(target_.http_port);
  return Answered("points as JSON", client.Ask("POST", "/v1/maps/" + target_.map_id + ":queryPoints", body));
}

bool BulkCalls::Voxels(std::int64_t submap) {
  const std::string name = "maps/" + target_.map_id + "/submaps/" + std::to_string(submap);
  const auto voxels = client_.Call(&testing::SubmapStub::StreamSubmapVoxels, name);
  return voxels.code() == grpc::StatusCode::NOT_FOUND || Answered("voxels", voxels.status());
}

bool BulkCalls::MeshOverRest() {
  http::HttpClient client(target_.http_port);
  return Answered("mesh over REST", client.Ask("GET", "/v1/maps/" + target_.map_id + "/mesh"));
}

void BulkCalls::Run(int first, const std::stop_token& stop) {
  for (int i = first; !stop.stop_requested(); ++i) {
    bool ok = false;
    switch (i % 6) {
      case 0: ok = WholeMesh(); break;
      case 1: ok = ManyPoints(kMuch); break;
      case 2: ok = MeshOverRest(); break;
      case 3: ok = ManyPointsAsJson(kMuchAsJson); break;
      case 4: ok = Voxels(1); break;
      default: ok = AbandonedMesh(); break;
    }
    ++num_calls_;
    if (!ok) ++num_failures_;
  }
}

}  // namespace dhpmap::rig

// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/load/door_calls.h"

#include <google/protobuf/util/json_util.h>

#include <chrono>
#include <thread>

namespace dhpmap::rig {
namespace {

constexpr std::size_t kMostComplaints = 10;
constexpr std::chrono::seconds kDoorDeadline{10};
constexpr char kProtobuf[] = "application/x-protobuf";

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

}  // namespace

DoorCalls::DoorCalls(const Target& target, unsigned seed)
    : target_(target),
      channel_(OwnChannel(target.grpc_address)),
      queries_(v1::QueryService::NewStub(channel_)),
      http_(target.http_port),
      random_(seed) {}

void DoorCalls::Run(double rate_hz, Table& table, const std::stop_token& stop) {
  constexpr double kNear_vox = 0.5;
  const std::chrono::duration<double> pause(rate_hz > 0 ? 1 / rate_hz : 0);
  for (std::size_t kind = 0; !stop.stop_requested(); kind = (kind + 1) % kKinds.size()) {
    const auto begin = Clock::now();
    const auto ask = [&]() -> Seconds {
      switch (kind) {
        case 0: return PointsOverGrpc();
        case 1: return DistancesOverGrpc(0);
        case 2: return DistancesOverGrpc(kNear_vox);
        case 3: return PointsAsJson();
        case 4: return DistancesAsJson();
        default: return DistancesAsProtobuf();
      }
    };
    if (const Seconds took_s = ask()) table[kind].Add(*took_s);
    else table[kind].AddFailure();
    std::this_thread::sleep_until(begin + pause);
  }
}

DoorCalls::Seconds DoorCalls::Complain(const std::string& what) {
  if (complaints_.size() < kMostComplaints) complaints_.push_back(what);
  return std::nullopt;
}

bool DoorCalls::IsRight(std::int64_t revision, int num_answered) {
  const bool is_right = num_answered == kPoints && revision >= revision_;
  if (!is_right) {
    (void)Complain(std::to_string(num_answered) + " answers of revision " + std::to_string(revision) + " after " +
                   std::to_string(revision_));
  }
  revision_ = revision;
  return is_right;
}

template <typename Request>
Request DoorCalls::About() {
  Request request;
  request.set_map("maps/" + target_.map_id);
  request.set_packed(true);
  const double x = Any(11), y = Any(8), z = Any(2.6);
  for (int i = 0; i < kPoints; ++i) {
    request.add_packed_points_m(static_cast<float>(x + Any(1)));
    request.add_packed_points_m(static_cast<float>(y + Any(1)));
    request.add_packed_points_m(static_cast<float>(z + Any(0.5)));
  }
  return request;
}

DoorCalls::Seconds DoorCalls::PointsOverGrpc() {
  const auto request = About<v1::QueryPointsRequest>();
  v1::QueryPointsResponse answer;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kDoorDeadline);
  const auto begin = Clock::now();
  const grpc::Status status = queries_->QueryPoints(&context, request, &answer);
  const double took_s = SecondsSince(begin);
  if (!status.ok()) return Complain("gRPC: " + status.error_message());
  return IsRight(answer.revision(), answer.packed().near_surface_size()) ? Seconds(took_s) : std::nullopt;
}

DoorCalls::Seconds DoorCalls::DistancesOverGrpc(double tolerance_vox) {
  auto request = About<v1::QueryDistancesRequest>();
  if (tolerance_vox > 0) request.mutable_options()->set_tolerance_vox(tolerance_vox);
  v1::QueryDistancesResponse answer;
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kDoorDeadline);
  const auto begin = Clock::now();
  const grpc::Status status = queries_->QueryDistances(&context, request, &answer);
  const double took_s = SecondsSince(begin);
  if (!status.ok()) return Complain("gRPC: " + status.error_message());
  return IsRight(answer.revision(), answer.packed().distance_m_size()) ? Seconds(took_s) : std::nullopt;
}

template <typename Response, typename Request>
DoorCalls::Seconds DoorCalls::AskInJson(const std::string& method, const Request& request, Response& answer) {
  std::string body;
  if (!google::protobuf::util::MessageToJsonString(request, &body).ok()) return Complain("JSON: not made");
  const auto begin = Clock::now();
  const http::HttpAnswer told = http_.Ask("POST", "/v1/maps/" + target_.map_id + ":" + method, body);
  const double took_s = SecondsSince(begin);
  if (told.status != 200 || !told.is_complete) return Complain("REST: " + std::to_string(told.status) + told.body);
  if (!google::protobuf::util::JsonStringToMessage(told.body, &answer).ok()) return Complain("JSON: not understood");
  return took_s;
}

DoorCalls::Seconds DoorCalls::PointsAsJson() {
  v1::QueryPointsResponse answer;
  const Seconds took_s = AskInJson("queryPoints", About<v1::QueryPointsRequest>(), answer);
  return took_s && IsRight(answer.revision(), answer.packed().near_surface_size()) ? took_s : std::nullopt;
}

DoorCalls::Seconds DoorCalls::DistancesAsJson() {
  v1::QueryDistancesResponse answer;
  const Seconds took_s = AskInJson("queryDistances", About<v1::QueryDistancesRequest>(), answer);
  return took_s && IsRight(answer.revision(), answer.packed().distance_m_size()) ? took_s : std::nullopt;
}

DoorCalls::Seconds DoorCalls::DistancesAsProtobuf() {
  const std::string body = About<v1::QueryDistancesRequest>().SerializeAsString();
  const auto begin = Clock::now();
  const http::HttpAnswer told = http_.Ask("POST", "/v1/maps/" + target_.map_id + ":queryDistances", body,
                                          {{"Content-Type", kProtobuf}, {"Accept", kProtobuf}});
  const double took_s = SecondsSince(begin);
  if (told.status != 200 || !told.is_complete) return Complain("REST: " + std::to_string(told.status) + told.body);
  v1::QueryDistancesResponse answer;
  if (!answer.ParseFromString(told.body)) return Complain("protobuf: not understood");
  return IsRight(answer.revision(), answer.packed().distance_m_size()) ? Seconds(took_s) : std::nullopt;
}

}  // namespace dhpmap::rig

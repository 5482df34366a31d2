// SPDX-License-Identifier: BSD-3-Clause
// What clients of one door hold in memory is not there for those of the other: the process has one bound.
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "dhpmap/v1/map_service.grpc.pb.h"
#include "dhpmap/v1/query_service.grpc.pb.h"
#include "tests/e2e/rest_fixture.h"
#include "tests/support/eventually.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

/// 12 MiB of 16 are for requests and answers of both doors; a quarter is gRPC's.
constexpr int kInflight_mib = 16;
constexpr std::size_t kBody_bytes = std::size_t{8} << 20;
constexpr int kNumPoints = 90'000;  ///< with their answers 11 MB, and more than 5 once these are made
constexpr double kAnswer_bytes = 5e6;

v1::QueryPointsRequest PointsOfRoom() {
  v1::QueryPointsRequest request;
  request.set_map("maps/room");
  request.set_packed(true);
  for (int i = 0; i < 3 * kNumPoints; ++i) request.add_packed_points_m(0.001f * static_cast<float>(i % 997));
  return request;
}

class OneBudget : public RestTest {
 protected:
  void SetUp() override {
    Start({{"DHPMAP_LIMITS_INFLIGHT_MIB", std::to_string(kInflight_mib)}});
    Create("room");
    channel_ = server_->Connect();
  }

  /// Announces a large body and does not send it: 100 if there is room, 429 if there is none.
  int Announce(http::HttpClient& client) {
    client.SendRaw("POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: " +
                   std::to_string(kBody_bytes) + "\r\n\r\n");
    return client.ReadAnswer().status;
  }
  /// As /metrics has it.
  double InflightBytes() {
    const std::string text = Ask("GET", "/metrics").body, name = "\ndhpmap_inflight_bytes ";
    const std::size_t at = text.find(name);
    return at == std::string::npos ? 0 : std::stod(text.substr(at + name.size(), 30));
  }
  int AnnounceAnother() {
    http::HttpClient client(http_port());
    return Announce(client);
  }
  grpc::Status AskMuch() {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kPatience);
    v1::QueryPointsResponse response;
    return v1::QueryService::NewStub(channel_)->QueryPoints(&context, PointsOfRoom(), &response);
  }
  void ExpectQuickAnswers() {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kPatience);
    v1::GetMapRequest request;
    request.set_name("maps/room");
    v1::GetMapResponse response;
    const grpc::Status got = v1::MapService::NewStub(channel_)->GetMap(&context, request, &response);
    EXPECT_TRUE(got.ok()) << got.error_message();
    EXPECT_EQ(Ask("GET", "/v1/maps/room").status, 200);
    EXPECT_EQ(Ask("GET", "/healthz").status, 200);
  }

  std::shared_ptr<grpc::Channel> channel_;
};

TEST_F(OneBudget, WhatABodyOverRestHoldsIsNotThereForGrpc) {
  ASSERT_TRUE(AskMuch().ok());
  std::optional<http::HttpClient> unfinished;
  const bool has_begun = Eventually([&] {  // once the call before has ended on the server, too
    unfinished.emplace(http_port());
    return Announce(*unfinished) == 100;
  });
  ASSERT_TRUE(has_begun);
  const grpc::Status refused = AskMuch();
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED) << refused.error_message();
  EXPECT_EQ(ReasonOf(refused), "TOO_MANY_BYTES");
  ExpectQuickAnswers();
  unfinished.reset();
  EXPECT_TRUE(Eventually([&] { return AskMuch().ok(); })) << "the client that left has given its bytes back";
}

TEST_F(OneBudget, WhatAnAnswerOverGrpcHoldsThatNobodyReadsIsNotThereForRest) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);  // else the client takes megabytes that nobody reads
  const auto stub = v1::QueryService::NewStub(
      grpc::CreateCustomChannel(server_->grpc_address(), grpc::InsecureChannelCredentials(), arguments));
  grpc::ClientContext context;
  const auto stream = stub->StreamQueries(&context);
  v1::StreamQueriesRequest request;
  *request.mutable_query_points() = PointsOfRoom();
  ASSERT_TRUE(stream->Write(request));
  ASSERT_TRUE(Eventually([&] { return InflightBytes() > kAnswer_bytes; }));
  EXPECT_EQ(AnnounceAnother(), 429);
  ExpectQuickAnswers();

  context.TryCancel();
  EXPECT_FALSE(stream->Finish().ok());
  EXPECT_TRUE(Eventually([&] { return AnnounceAnother() == 100; })) << "the stream has given its bytes back";
}

}  // namespace
}  // namespace dhpmap::testing

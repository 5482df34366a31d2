// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/query_service.pb.h"
#include "server/base/byte_budget.h"
#include "server/base/lane.h"
#include "server/gateway/rpc_call.h"
#include "server/gateway/rpc_exchange.h"
#include "tests/support/lane_plug.h"
#include "tests/unit/server/gateway/gateway_fixture.h"
#include "tests/unit/server/gateway/recording_responder.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

TEST_F(GatewayTest, GetFillsTheRequestFromThePathAndAnswersJson) {
  v1::GetMapResponse response;
  response.mutable_map()->set_name("maps/home");
  response.set_revision(42);
  server.Set("GetMap", {.messages = {response.SerializeAsString()}});
  const http::HttpAnswer answer = client->Ask("GET", "/v1/maps/home");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.Header("Content-Type"), "application/json");
  const auto json = AsJson(answer.body);
  EXPECT_EQ(At(json, "revision").string_value(), "42");
  EXPECT_EQ(At(At(json, "map").struct_value(), "num_frames").string_value(), "0") << "zeros are shown";
  EXPECT_EQ(Heard<v1::GetMapRequest>().name(), "maps/home");
  EXPECT_EQ(server.WaitForCall().method, "/dhpmap.v1.MapService/GetMap");
}

TEST_F(GatewayTest, PostAcceptsJsonUnderCurlsDefaultContentType) {
  const std::string body = R"({"map_id":"home","config":{"voxelSizeM":0.05,"integration":{"antiGrazing":true}}})";
  for (const char* type :
       {"application/json", "application/x-www-form-urlencoded", "Application/JSON; charset=utf-8"}) {
    const http::HttpAnswer answer = client->Ask("POST", "/v1/maps", body, {{"Content-Type", type}});
    EXPECT_EQ(answer.status, 200) << answer.body;
  }
  EXPECT_EQ(client->Ask("POST", "/v1/maps", body).status, 200) << "no content type";
  const auto heard = Heard<v1::CreateMapRequest>(4);
  EXPECT_EQ(heard.map_id(), "home");
  EXPECT_DOUBLE_EQ(heard.config().voxel_size_m(), 0.05);
  EXPECT_TRUE(heard.config().integration().anti_grazing());
}

TEST_F(GatewayTest, LargeBodiesUnderCurlsDefaultTypeAreNotForms) {
  DHPMAP_SKIP_MEGABYTES();
  std::string body = R"({"packed_points_m":[0)";
  while (body.size() < 300'000) body += ",0.25,-1.5,2";
  body += ",1,2]}";
  const http::HttpAnswer answer =
      client->Ask("POST", "/v1/maps/a:queryPoints", body, {{"Content-Type", "application/x-www-form-urlencoded"}});
  EXPECT_EQ(answer.status, 200) << answer.body;
  EXPECT_GT(Heard<v1::QueryPointsRequest>().packed_points_m_size(), 70'000);
}

TEST_F(GatewayTest, AnAnswerWithAFileIsSentAsAFileUnlessJsonIsRequested) {
  v1::QueryOccupancySliceResponse slice;
  slice.set_data("P5\n1 1\n255\n\xfe");
  slice.set_content_type("image/x-portable-graymap");
  server.Set("QueryOccupancySlice", {.messages = {slice.SerializeAsString()}});
  const std::string path = "/v1/maps/home:queryOccupancySlice?min_z_m=0.1&max_z_m=1&area.min_x_m=-2&format=PGM";
  const http::HttpAnswer file = client->Ask("GET", path, "", {{"Accept", "*/*"}});
  EXPECT_EQ(file.status, 200);
  EXPECT_EQ(file.body, slice.data());
  EXPECT_EQ(file.Header("Content-Type"), "image/x-portable-graymap");
  EXPECT_EQ(file.Header("Content-Disposition"), "attachment; filename=\"maps_home.pgm\"");
  const auto heard = Heard<v1::QueryOccupancySliceRequest>();
  EXPECT_EQ(heard.area().min_x_m(), -2);
  EXPECT_EQ(heard.format(), v1::QueryOccupancySliceRequest::PGM);
  const http::HttpAnswer json = client->Ask("GET", path, "", {{"Accept", "application/json"}});
  EXPECT_EQ(At(AsJson(json.body), "data").string_value(), "UDUKMSAxCjI1NQr+");
  EXPECT_EQ(client->Ask("GET", path, "", {{"Accept", "image/png"}}).status, 406);
  EXPECT_EQ(client->Ask("GET", path, "", {{"Accept", "image/*"}}).body, slice.data());
  slice.clear_content_type();
  slice.set_cells("\x64");
  server.Set("QueryOccupancySlice", {.messages = {slice.SerializeAsString()}});
  EXPECT_EQ(client->Ask("POST", "/v1/maps/home:queryOccupancySlice", "{}").Header("Content-Type"), "application/json")
      << "an answer that may hold a file, and does not";
}

TEST_F(GatewayTest, ProtobufWorksInBothDirections) {
  v1::QueryPointsRequest request;
  request.add_packed_points_m(1.5f);
  request.set_map("maps/wrong");  // the path wins
  v1::QueryPointsResponse response;
  response.set_revision(7);
  server.Set("QueryPoints", {.messages = {response.SerializeAsString()}});
  const http::HttpAnswer answer =
      client->Ask("POST", "/v1/maps/right:queryPoints", request.SerializeAsString(),
                  {{"Content-Type", "application/x-protobuf"}, {"Accept", "application/x-protobuf"}});
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.Header("Content-Type"), "application/x-protobuf");
  EXPECT_EQ(answer.body, response.SerializeAsString());
  const auto heard = Heard<v1::QueryPointsRequest>();
  EXPECT_EQ(heard.map(), "maps/right");
  EXPECT_EQ(heard.packed_points_m(0), 1.5f);
}

TEST_F(GatewayTest, ForwardsMetadataAndGivesEveryRequestAnId) {
  const http::HttpAnswer answer = client->Ask(
      "GET", "/v1/maps", "",
      {{"Authorization", "Bearer t"}, {"X-Request-ID", "r-1"}, {"TraceParent", "00-1-2-01"}, {"Cookie", "c=1"}});
  EXPECT_EQ(answer.Header("X-Request-Id"), "r-1");
  const HeardCall call = server.WaitForCall();
  EXPECT_EQ(call.metadata.find("authorization")->second, "Bearer t");
  EXPECT_EQ(call.metadata.find("x-request-id")->second, "r-1");
  EXPECT_EQ(call.metadata.find("traceparent")->second, "00-1-2-01");
  EXPECT_EQ(call.metadata.count("cookie"), 0u);
  const std::string first = client->Ask("GET", "/v1/maps").Header("X-Request-Id");
  const std::string second = client->Ask("GET", "/v1/maps").Header("X-Request-Id");
  EXPECT_FALSE(first.empty());
  EXPECT_NE(first, second);
}

TEST_F(GatewayTest, InvalidMetadataIsRefused) {
  EXPECT_EQ(client->Ask("GET", "/v1/maps", "", {{"Authorization", "Bearer \xC3\xA4"}}).status, 400);
  EXPECT_EQ(client->Ask("GET", "/v1/maps", "", {{"X-Request-Id", "a\tb"}}).status, 400);
  EXPECT_EQ(client->Ask("GET", "/v1/maps").status, 200) << "the server is still up";
}

TEST_F(GatewayTest, TimeoutsBecomeDeadlines) {
  server.Set("GetMap", {.hang = true});
  const http::HttpAnswer late = client->Ask("GET", "/v1/maps/a", "", {{"X-Timeout-S", "0.05"}});
  EXPECT_EQ(late.status, 504);
  EXPECT_EQ(At(AsJson(late.body), "code").number_value(), 4);
  EXPECT_EQ(client->Ask("GET", "/v1/maps/a", "", {{"grpc-timeout", "50m"}}).status, 504);
  for (const char* bad : {"soon", "-1", "nan", "1S"}) {
    EXPECT_EQ(client->Ask("GET", "/v1/maps/a", "", {{"X-Timeout-S", bad}}).status, 400) << bad;
  }
  EXPECT_EQ(client->Ask("GET", "/v1/maps/a", "", {{"grpc-timeout", "5"}}).status, 400);
  EXPECT_EQ(client->Ask("GET", "/v1/maps", "", {{"X-Timeout-S", "1e300"}}).status, 200) << "as good as none";
}

TEST_F(GatewayTest, ADisconnectedClientCancelsTheRpc) {
  server.Set("GetMap", {.hang = true});
  client->SendRaw("GET /v1/maps/a HTTP/1.1\r\nHost: localhost\r\n\r\n");
  server.WaitForCall();
  client.reset();
  EXPECT_TRUE(server.WaitForCancel());
}

TEST_F(GatewayTest, AnAnswerOfTheWrongTypeIsAnInternalError) {
  server.Set("GetMap", {.messages = {"\xFF\xFF"}});
  const http::HttpAnswer answer = client->Ask("GET", "/v1/maps/a");
  EXPECT_EQ(answer.status, 500);
  EXPECT_EQ(At(AsJson(answer.body), "code").number_value(), 13);
}

/// An exchange without a connection.
class UnaryExchangeTest : public ::testing::Test {
 protected:
  /// Calls, and the exchanges that they hold, end before the objects that they use.
  ~UnaryExchangeTest() override {
    EXPECT_TRUE(responder->RunUntil([&] { return caller.WaitUntilIdle(std::chrono::milliseconds(0)); }));
  }

  std::shared_ptr<http::Exchange> Begin(const http::RequestHead& head, std::size_t max_body_bytes = 1000) {
    auto request = RpcRequest::Make(head, Matched(head.method, head.target), "", max_body_bytes);
    EXPECT_TRUE(request.ok());
    return MakeUnaryExchange(std::move(*request), ByteShare(&budget), {&caller, &bulk}, responder);
  }
  bool HasReply() const { return !responder->replies.empty(); }

  CannedServer server;
  ByteBudget budget{2000};
  std::shared_ptr<RecordingResponder> responder = std::make_shared<RecordingResponder>();
  RpcCaller caller{server.channel()};
  Lane bulk{{}};
};

TEST_F(UnaryExchangeTest, JoinsTheBodyAndAnswersOnce) {
  const auto exchange = Begin(RequestHeadOf("POST", "/v1/maps"));
  for (const char c : std::string(R"({"map_id":"home"})")) EXPECT_TRUE(exchange->OnBody({&c, 1}));
  EXPECT_EQ(server.num_calls(), 0u) << "not before the body is whole";
  exchange->OnBodyEnd();
  ASSERT_TRUE(responder->RunUntil([&] { return HasReply(); }));
  EXPECT_EQ(responder->replies.size(), 1u);
  EXPECT_EQ(responder->replies[0].status, 200);
  EXPECT_FALSE(http::FindHeader(responder->replies[0].headers, "x-request-id").empty());
}

TEST_F(UnaryExchangeTest, ABodyThatExceedsTheLimitIsAnsweredAndTheRestDropped) {
  const auto exchange = Begin(RequestHeadOf("POST", "/v1/maps", {{"Transfer-Encoding", "chunked"}}), 100);
  EXPECT_TRUE(exchange->OnBody(std::string(100, ' ')));
  EXPECT_FALSE(HasReply());
  EXPECT_TRUE(exchange->OnBody("x"));
  ASSERT_TRUE(HasReply());
  EXPECT_EQ(responder->replies[0].status, 413);
  EXPECT_TRUE(exchange->OnBody(std::string(1000, 'x'))) << "the connection decides what to do with the rest";
  exchange->OnBodyEnd();
  EXPECT_EQ(responder->replies.size(), 1u);
  EXPECT_EQ(server.num_calls(), 0u);
}

TEST_F(UnaryExchangeTest, ABodyBeyondTheBudgetIsAnswered) {
  ByteShare others(&budget);
  ASSERT_TRUE(others.Resize(1950));
  auto exchange = Begin(RequestHeadOf("POST", "/v1/maps", {{"Transfer-Encoding", "chunked"}}));
  EXPECT_TRUE(exchange->OnBody(std::string(60, ' ')));
  ASSERT_TRUE(HasReply());
  EXPECT_EQ(responder->replies[0].status, 429);
  exchange.reset();
  EXPECT_EQ(budget.used_bytes(), 1950u);
}

TEST_F(UnaryExchangeTest, AnAnswerBeyondTheBudgetIsNotKept) {
  v1::GetMapResponse response;
  response.mutable_map()->set_display_name(std::string(2000, 'x'));
  server.Set("GetMap", {.messages = {response.SerializeAsString()}});
  auto exchange = Begin(RequestHeadOf("GET", "/v1/maps/a"));
  exchange->OnBodyEnd();
  ASSERT_TRUE(responder->RunUntil([&] { return HasReply(); }));
  EXPECT_EQ(responder->replies[0].status, 429);
  exchange.reset();
  ASSERT_TRUE(caller.WaitUntilIdle(std::chrono::minutes(1)));
  EXPECT_EQ(budget.used_bytes(), 0u);
}

/// Exchanges with memory for large messages, and a lane that other work occupies until it is released.
class LargeUnaryExchangeTest : public UnaryExchangeTest {
 protected:
  static constexpr std::size_t kLarge = 10 * kMostQuickBytes;

  std::shared_ptr<http::Exchange> BeginLarge(const std::string& body, std::shared_ptr<RecordingResponder> to) {
    auto request = RpcRequest::Make(RequestHeadOf("POST", "/v1/maps", {}, body.size()), Matched("POST", "/v1/maps"), "",
                                    2 * kLarge);
    EXPECT_TRUE(request.ok());
    ByteShare share(&room);
    EXPECT_TRUE(share.Resize(body.size()));
    auto exchange = MakeUnaryExchange(std::move(*request), std::move(share), {&caller, &bulk}, std::move(to));
    EXPECT_TRUE(exchange->OnBody(body));
    exchange->OnBodyEnd();
    return exchange;
  }
  static std::string LargeBody() { return R"({"map_id":"large")" + std::string(kLarge, ' ') + "}"; }

  ByteBudget room{100 * kLarge};
  testing::LanePlug plug{bulk};
};

TEST_F(LargeUnaryExchangeTest, ALargeBodyIsReadOnTheLaneAndASmallOneDoesNotWait) {
  const auto large = BeginLarge(LargeBody(), responder);
  const auto others = std::make_shared<RecordingResponder>();
  const auto small = BeginLarge(R"({"map_id":"small"})", others);
  ASSERT_TRUE(others->RunUntil([&] { return !others->replies.empty(); }));
  EXPECT_EQ(others->replies[0].status, 200);
  EXPECT_EQ(server.num_calls(), 1u) << "the large one is still to be read";
  EXPECT_FALSE(HasReply());
  plug.Release();
  ASSERT_TRUE(responder->RunUntil([&] { return HasReply(); }));
  EXPECT_EQ(responder->replies[0].status, 200);
}

TEST_F(LargeUnaryExchangeTest, ALargeAnswerIsMadeOnTheLaneAndASmallOneDoesNotWait) {
  v1::CreateMapResponse response;
  response.mutable_map()->set_display_name(std::string(kLarge, 'x'));
  server.Set("CreateMap", {.messages = {response.SerializeAsString()}});
  server.Set("GetMap", {.messages = {""}});
  const auto large = BeginLarge("{}", responder);
  server.WaitForCall();
  const auto others = std::make_shared<RecordingResponder>();
  auto request = RpcRequest::Make(RequestHeadOf("GET", "/v1/maps/a"), Matched("GET", "/v1/maps/a"), "", kLarge);
  ASSERT_TRUE(request.ok());
  const auto small = MakeUnaryExchange(std::move(*request), ByteShare(&room), {&caller, &bulk}, others);
  small->OnBodyEnd();
  ASSERT_TRUE(others->RunUntil([&] { return !others->replies.empty(); }));
  EXPECT_FALSE(HasReply());
  plug.Release();
  ASSERT_TRUE(responder->RunUntil([&] { return HasReply(); }));
  EXPECT_GT(responder->replies[0].body.size(), kLarge);
}

TEST_F(LargeUnaryExchangeTest, ABodyOfADisconnectedClientIsNotParsed) {
  auto exchange = BeginLarge(LargeBody(), responder);
  EXPECT_GE(room.used_bytes(), kLarge);
  exchange->OnClosed();
  exchange.reset();
  EXPECT_EQ(room.used_bytes(), 0u) << "given back before the lane has come to it";
  plug.Release();
  EXPECT_EQ(server.num_calls(), 0u);
}

TEST_F(UnaryExchangeTest, AClosedConnectionGetsNoFurtherCalls) {
  server.Set("GetMap", {.hang = true});
  const auto exchange = Begin(RequestHeadOf("GET", "/v1/maps/a"));
  exchange->OnBodyEnd();
  server.WaitForCall();
  exchange->OnClosed();
  EXPECT_TRUE(server.WaitForCancel());
  bool is_idle = false;
  EXPECT_TRUE(responder->RunUntil([&] { return std::exchange(is_idle, true); })) << "what the call still says";
  EXPECT_FALSE(HasReply());
}

}  // namespace
}  // namespace dhpmap::gateway

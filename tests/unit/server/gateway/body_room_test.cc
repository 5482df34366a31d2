// SPDX-License-Identifier: BSD-3-Clause
// Bodies that grow many times when parsed.
#include "server/gateway/body_room.h"

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "server/base/lane.h"
#include "server/gateway/rpc_call.h"
#include "server/gateway/rpc_exchange.h"
#include "tests/unit/server/gateway/gateway_fixture.h"
#include "tests/unit/server/gateway/recording_responder.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

constexpr int kNumPoints = 100'000;  // of 3 bytes, 2 in protobuf; some 60 as messages

struct TinyBody {
  std::string type, text;
};
std::vector<TinyBody> TinyBodies() {
  std::string json = R"({"points_m":[{})", protobuf, unknown;
  for (int i = 1; i < kNumPoints; ++i) json += ",{}";
  for (int i = 0; i < kNumPoints; ++i) protobuf += std::string("\x1a\x00", 2);
  for (int i = 0; i < kNumPoints; ++i) unknown += std::string("\x7a\x00", 2);
  return {{"application/json", json + "]}"}, {"application/x-protobuf", protobuf}, {"application/x-protobuf", unknown}};
}

class BodyRoomTest : public ::testing::Test {
 protected:
  ~BodyRoomTest() override {
    EXPECT_TRUE(responder->RunUntil([&] { return caller.WaitUntilIdle(std::chrono::milliseconds(0)); }));
  }

  http::Response AnswerTo(const std::string& path, const TinyBody& body, ByteBudget& budget) {
    responder->replies.clear();
    const http::RequestHead head = RequestHeadOf("POST", path, {{"Content-Type", body.type}}, body.text.size());
    auto request = RpcRequest::Make(head, Matched("POST", path), "", 1u << 20);
    EXPECT_TRUE(request.ok());
    ByteShare share(&budget);
    const bool is_stream = request->route->is_stream();
    const RpcBackend backend{.caller = &caller, .bulk = &bulk};
    const auto exchange = is_stream ? MakeStreamExchange(std::move(*request), std::move(share), backend, responder)
                                    : MakeUnaryExchange(std::move(*request), std::move(share), backend, responder);
    exchange->OnBody(body.text);
    exchange->OnBodyEnd();
    EXPECT_TRUE(responder->RunUntil([&] { return !responder->replies.empty(); }));
    exchange->OnClosed();
    return responder->replies.empty() ? http::Response() : responder->replies[0];
  }

  std::deque<ByteBudget> budgets;  // outlive the tests: a lane may free the last exchange after its answer
  CannedServer server;
  std::shared_ptr<RecordingResponder> responder = std::make_shared<RecordingResponder>();
  RpcCaller caller{server.channel()};
  Lane bulk{{}};
};

TEST_F(BodyRoomTest, AMessageThatCanNeverFitIsTooLarge) {
  ByteBudget& budget = budgets.emplace_back(2u << 20);
  for (const TinyBody& body : TinyBodies()) {
    const http::Response answer = AnswerTo("/v1/maps/a:queryPoints", body, budget);
    EXPECT_EQ(answer.status, 413) << body.type;
    EXPECT_NE(answer.body.find("BODY_TOO_LARGE"), std::string::npos) << answer.body;
  }
  EXPECT_EQ(server.num_calls(), 0u);
}

TEST_F(BodyRoomTest, WithoutMemoryForTheMessageTheClientMayRetry) {
  ByteBudget& budget = budgets.emplace_back(64u << 20);
  {
    ByteShare others(&budget);
    ASSERT_TRUE(others.Resize(62u << 20));
    for (const TinyBody& body : TinyBodies()) {
      const http::Response answer = AnswerTo("/v1/maps/a:queryPoints", body, budget);
      EXPECT_EQ(answer.status, 429) << body.type;
      EXPECT_NE(answer.body.find("TOO_MANY_BYTES"), std::string::npos) << answer.body;
    }
    EXPECT_EQ(server.num_calls(), 0u);
  }
  for (const TinyBody& body : TinyBodies()) {
    EXPECT_EQ(AnswerTo("/v1/maps/a:queryPoints", body, budget).status, 200) << body.type;
  }
}

TEST_F(BodyRoomTest, MessagesOfStreamsAreCountedToo) {
  ByteBudget& budget = budgets.emplace_back(2u << 20);
  TinyBody body = TinyBodies()[0];
  body.text = R"({"query_points":)" + body.text + "}";
  const http::Response answer = AnswerTo("/v1/maps:streamQueries", body, budget);
  EXPECT_EQ(answer.status, 413);
  EXPECT_NE(answer.body.find("BODY_TOO_LARGE"), std::string::npos) << answer.body;
}

TEST_F(BodyRoomTest, ASmallBodyIsAcceptedWhenTheBudgetIsSpent) {
  ByteBudget& budget = budgets.emplace_back(1u << 20, 16u << 10);
  ByteShare others(&budget);
  ASSERT_TRUE(others.Resize(1u << 20));
  EXPECT_EQ(AnswerTo("/v1/maps/a:queryPoints", {"application/json", R"({"points_m":[{},{},{}]})"}, budget).status, 200);
  std::string many = R"({"points_m":[{})";
  while (many.size() < (15u << 10)) many += ",{}";
  EXPECT_EQ(AnswerTo("/v1/maps/a:queryPoints", {"application/json", many + "]}"}, budget).status, 429)
      << "as a message it is not small";
}

}  // namespace
}  // namespace dhpmap::gateway

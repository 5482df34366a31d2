// SPDX-License-Identifier: BSD-3-Clause
// Large messages of streams are converted on a lane; behaviour is otherwise the same.
#include <chrono>
#include <future>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "dhpmap/v1/mapping_service.pb.h"
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

constexpr std::size_t kLargeData_bytes = 4 * kMostQuickBytes;  // in base64: a multiple of 4

std::string WithData(int sequence, std::size_t num_bytes) {
  return R"({"frame":{"depth_camera":{"depth":{"data":")" + std::string(num_bytes, 'A') + R"("}}},"sequence":)" +
         std::to_string(sequence) + "}\n";
}
std::string SmallMessage(int sequence) { return WithData(sequence, 4); }
std::string LargeMessage(int sequence) { return WithData(sequence, kLargeData_bytes); }
std::string BrokenLargeMessage() { return "{\"sequence\":x" + std::string(kLargeData_bytes, ' ') + "}\n"; }

CannedAnswer AcknowledgesSequences() {
  return {.acknowledge = [](const std::string& bytes) {
    v1::IntegrateFramesRequest request;
    request.ParseFromString(bytes);
    v1::IntegrateFramesResponse response;
    response.set_sequence(request.sequence());
    return response.SerializeAsString();
  }};
}

/// Exchanges that share a lane, which other work occupies until it is released.
class LargeStreamMessagesTest : public ::testing::Test {
 protected:
  /// Calls, and the exchanges that they hold, end before the objects that they use.
  ~LargeStreamMessagesTest() override {
    LetLaneGo();
    EXPECT_TRUE(responder->RunUntil([&] { return caller.WaitUntilIdle(std::chrono::milliseconds(0)); }));
  }

  void LetLaneGo() {
    if (!std::exchange(is_let_go, true)) plug.Release();
  }
  /// Returns once all earlier tasks have run.
  void WaitForLane() {
    std::promise<void> reached;
    bulk.Post([&reached] { reached.set_value(); });
    reached.get_future().wait();
  }

  std::shared_ptr<http::Exchange> Begin(const std::string& path, std::shared_ptr<RecordingResponder> to,
                                        Lane* for_frames = nullptr) {
    const http::RequestHead head = RequestHeadOf("POST", path, {{"Transfer-Encoding", "chunked"}});
    auto request = RpcRequest::Make(head, Matched("POST", path), "", 10 * kLargeData_bytes);
    EXPECT_TRUE(request.ok());
    return MakeStreamExchange(std::move(*request), ByteShare(&room),
                              {.caller = &caller, .bulk = &bulk, .frames = for_frames}, std::move(to));
  }
  std::shared_ptr<http::Exchange> BeginFrames() { return Begin("/v1/maps/a:integrateFrames", responder); }

  bool HasBegunCall() { return !caller.WaitUntilIdle(std::chrono::milliseconds(0)); }

  /// The lines of the answer, up to its end.
  static std::vector<google::protobuf::Struct> ReadLines(http::Exchange& exchange, RecordingResponder& from) {
    std::string text;
    const auto has_more = [&] { return !from.chunks.empty() || !from.ends.empty() || !from.replies.empty(); };
    while (from.RunUntil(has_more) && !from.chunks.empty()) {
      text += from.chunks.back();
      from.chunks.clear();
      exchange.OnWritten();
    }
    std::vector<google::protobuf::Struct> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(AsJson(line));
    return lines;
  }
  static std::string SequenceOf(const google::protobuf::Struct& line) {
    return At(At(line, "result").struct_value(), "sequence").string_value();
  }

  CannedServer server;
  ByteBudget room{100 * kLargeData_bytes};
  std::shared_ptr<RecordingResponder> responder = std::make_shared<RecordingResponder>();
  RpcCaller caller{server.channel()};
  Lane bulk{{}};
  testing::LanePlug plug{bulk};
  bool is_let_go = false;
};

TEST_F(LargeStreamMessagesTest, ALargeMessageWaitsForTheLaneAndASmallStreamDoesNot) {
  server.Set("IntegrateFrames", AcknowledgesSequences());
  auto large = BeginFrames();
  EXPECT_FALSE(large->OnBody(LargeMessage(1))) << "no more of the body meanwhile";
  EXPECT_FALSE(HasBegunCall()) << "it is still to be converted";
  EXPECT_GE(room.used_bytes(), kLargeData_bytes) << "and counts";
  const auto others = std::make_shared<RecordingResponder>();
  auto small = Begin("/v1/maps/b:integrateFrames", others);
  small->OnBody(SmallMessage(7));
  small->OnBodyEnd();
  const auto small_lines = ReadLines(*small, *others);
  ASSERT_EQ(small_lines.size(), 1u);
  EXPECT_EQ(SequenceOf(small_lines[0]), "7");
  EXPECT_EQ(responder->num_resumed, 0);
  LetLaneGo();
  ASSERT_TRUE(responder->RunUntil([&] { return responder->num_resumed > 0; }));
  large->OnBodyEnd();
  const auto lines = ReadLines(*large, *responder);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(SequenceOf(lines[0]), "1");
  EXPECT_EQ(responder->num_resumed, 1);
  small.reset();
  large.reset();
  EXPECT_TRUE(responder->RunUntil([&] { return room.used_bytes() == 0; })) << room.used_bytes();
}

TEST_F(LargeStreamMessagesTest, LargeAndSmallMessagesKeepTheirOrder) {
  server.Set("IntegrateFrames", AcknowledgesSequences());
  const auto exchange = BeginFrames();
  exchange->OnBody(LargeMessage(1) + SmallMessage(2) + SmallMessage(3) + LargeMessage(4) + LargeMessage(5) +
                   SmallMessage(6));
  EXPECT_FALSE(HasBegunCall()) << "what is small waits for what comes before it";
  exchange->OnBodyEnd();
  LetLaneGo();
  const auto lines = ReadLines(*exchange, *responder);
  ASSERT_EQ(lines.size(), 6u);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(SequenceOf(lines[static_cast<std::size_t>(i)]), std::to_string(i + 1));
  EXPECT_EQ(responder->ends, std::vector<bool>{true});
}

TEST_F(LargeStreamMessagesTest, TheRpcLearnsThatALargeMessageIsTheOnlyOne) {
  server.Set("IntegrateFrames", AcknowledgesSequences());
  const std::string body = LargeMessage(1);
  const http::RequestHead head = RequestHeadOf("POST", "/v1/maps/a:integrateFrames", {}, body.size());
  auto request = RpcRequest::Make(head, Matched(head.method, head.target), "", 10 * kLargeData_bytes);
  ASSERT_TRUE(request.ok());
  const auto exchange = MakeStreamExchange(std::move(*request), ByteShare(&room), {&caller, &bulk}, responder);
  exchange->OnBody(body);
  exchange->OnBodyEnd();
  EXPECT_FALSE(HasBegunCall());
  LetLaneGo();
  EXPECT_EQ(ReadLines(*exchange, *responder).size(), 1u);
  EXPECT_TRUE(server.WaitForCall().metadata.contains("dhpmap-one-message"));
}

TEST_F(LargeStreamMessagesTest, AMalformedLargeMessageEndsTheStreamAfterTheValidOnes) {
  server.Set("IntegrateFrames", AcknowledgesSequences());
  const auto exchange = BeginFrames();
  exchange->OnBody(SmallMessage(1) + BrokenLargeMessage() + SmallMessage(3));
  LetLaneGo();
  const auto lines = ReadLines(*exchange, *responder);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(SequenceOf(lines[0]), "1");
  const auto error = At(lines[1], "error").struct_value();
  EXPECT_EQ(At(error, "code").number_value(), 3);
  EXPECT_NE(At(error, "message").string_value().find("message 2: malformed JSON"), std::string::npos);
  EXPECT_EQ(responder->num_resumed, 1) << "the rest of the body is let go";
}

TEST_F(LargeStreamMessagesTest, AMalformedLargeFirstMessageIsAPlainErrorWithoutACall) {
  const auto exchange = BeginFrames();
  EXPECT_FALSE(exchange->OnBody(BrokenLargeMessage()));
  EXPECT_TRUE(responder->replies.empty());
  LetLaneGo();
  ASSERT_TRUE(responder->RunUntil([&] { return !responder->replies.empty(); }));
  EXPECT_EQ(responder->replies[0].status, 400);
  EXPECT_NE(responder->replies[0].body.find("message 1: malformed JSON"), std::string::npos);
  EXPECT_EQ(responder->num_resumed, 1) << "the rest of the body is let go";
  EXPECT_TRUE(exchange->OnBody(SmallMessage(2)));
  exchange->OnBodyEnd();
  EXPECT_EQ(responder->replies.size(), 1u);
  EXPECT_EQ(server.num_calls(), 0u);
}

TEST_F(LargeStreamMessagesTest, ALargeMessageBeyondTheBudgetIsRefusedAtOnce) {
  ByteShare others(&room);
  ASSERT_TRUE(others.Resize(room.limit_bytes() - kLargeData_bytes));
  auto exchange = BeginFrames();
  EXPECT_TRUE(exchange->OnBody(LargeMessage(1))) << "the rest is let go";
  ASSERT_TRUE(responder->RunUntil([&] { return !responder->replies.empty(); }));
  EXPECT_EQ(responder->replies[0].status, 429);
  EXPECT_NE(responder->replies[0].body.find("TOO_MANY_BYTES"), std::string::npos);
  exchange.reset();
  EXPECT_EQ(room.used_bytes(), others.bytes());
}

TEST_F(LargeStreamMessagesTest, AMessageOfADisconnectedClientIsNotConverted) {
  auto exchange = BeginFrames();
  EXPECT_FALSE(exchange->OnBody(LargeMessage(1)));
  exchange->OnClosed();
  const std::weak_ptr<http::Exchange> left = exchange;
  exchange.reset();
  EXPECT_TRUE(left.expired()) << "the lane does not keep it";
  EXPECT_EQ(room.used_bytes(), 0u);
  EXPECT_FALSE(HasBegunCall());
}

TEST_F(LargeStreamMessagesTest, AConvertedMessageOfADisconnectedClientIsDropped) {
  auto exchange = BeginFrames();
  EXPECT_FALSE(exchange->OnBody(LargeMessage(1)));
  LetLaneGo();
  WaitForLane();  // the outcome is on its way to the connection
  exchange->OnClosed();
  const std::weak_ptr<http::Exchange> left = exchange;
  exchange.reset();
  EXPECT_TRUE(responder->RunUntil([&] { return left.expired(); }));
  EXPECT_EQ(room.used_bytes(), 0u);
  EXPECT_FALSE(HasBegunCall());
  EXPECT_TRUE(responder->replies.empty());
}

TEST_F(LargeStreamMessagesTest, AnEndedRpcIsAnsweredWhileAMessageStillWaits) {
  server.Set("IntegrateFrames", {.messages = {}, .status = grpc::Status(grpc::NOT_FOUND, "no map a")});
  const auto exchange = BeginFrames();
  EXPECT_FALSE(exchange->OnBody(SmallMessage(1) + LargeMessage(2)));
  ASSERT_TRUE(responder->RunUntil([&] { return !responder->replies.empty(); }));
  EXPECT_EQ(responder->replies[0].status, 404);
  EXPECT_EQ(responder->num_resumed, 1);
  LetLaneGo();
  WaitForLane();
  EXPECT_EQ(responder->replies.size(), 1u);
}

TEST_F(LargeStreamMessagesTest, FramesDoNotWaitForOtherRequests) {
  Lane frames{{}};
  server.Set("IntegrateFrames", AcknowledgesSequences());
  server.Set("QueryDistanceGrid", {.messages = {""}});
  const auto asking = std::make_shared<RecordingResponder>();
  const auto question = Begin("/v1/maps/a:queryDistanceGrid", asking, &frames);
  question->OnBody("{" + std::string(kLargeData_bytes, ' ') + "}");
  question->OnBodyEnd();
  EXPECT_FALSE(HasBegunCall()) << "a large question is the bulk lane's";
  const auto feed = Begin("/v1/maps/a:integrateFrames", responder, &frames);
  feed->OnBody(LargeMessage(1));
  feed->OnBodyEnd();
  EXPECT_EQ(ReadLines(*feed, *responder).size(), 1u);
  EXPECT_TRUE(asking->chunks.empty());
  LetLaneGo();
  EXPECT_EQ(ReadLines(*question, *asking).size(), 1u);
}

}  // namespace
}  // namespace dhpmap::gateway

// SPDX-License-Identifier: BSD-3-Clause
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/util/delimited_message_util.h>

#include <sstream>
#include <thread>

#include "dhpmap/v1/mapping_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "google/rpc/status.pb.h"
#include "json_test.pb.h"
#include "server/base/byte_budget.h"
#include "server/base/lane.h"
#include "server/gateway/rpc_call.h"
#include "server/gateway/rpc_exchange.h"
#include "server/gateway/stream_state.h"
#include "server/gateway/transcoder.h"
#include "tests/support/lane_plug.h"
#include "tests/unit/server/gateway/gateway_fixture.h"
#include "tests/unit/server/gateway/mesh_part.h"
#include "tests/unit/server/gateway/recording_responder.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

using json::test::Everything;

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string Voxels(int revision) {
  v1::StreamSubmapVoxelsResponse message;
  message.set_revision(revision);
  return message.SerializeAsString();
}

/// Acknowledges a frame with its sequence number and the map of its request.
std::string Acknowledge(const std::string& bytes) {
  v1::IntegrateFramesRequest request;
  request.ParseFromString(bytes);
  v1::IntegrateFramesResponse response;
  response.set_sequence(request.sequence());
  response.mutable_error()->set_message(request.map());
  return response.SerializeAsString();
}

std::string Frame(int sequence) { return R"({"sequence":)" + std::to_string(sequence) + "}"; }

TEST_F(GatewayTest, ServerStreamsAreNdjsonInChunks) {
  server.Set("StreamSubmapVoxels", {.messages = {Voxels(1), Voxels(2), Voxels(3)}});
  const http::HttpAnswer answer = client->Ask("GET", "/v1/maps/a/submaps/1/voxels?max_abs_tsdf_m=0.5");
  EXPECT_EQ(answer.status, 200);
  EXPECT_TRUE(answer.was_chunked);
  EXPECT_EQ(answer.Header("Content-Type"), "application/x-ndjson");
  const auto lines = Lines(answer.body);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(At(At(AsJson(lines[2]), "result").struct_value(), "revision").string_value(), "3");
  EXPECT_EQ(Heard<v1::StreamSubmapVoxelsRequest>().max_abs_tsdf_m(), 0.5);
  EXPECT_EQ(client->Ask("GET", "/healthz").status, 200) << "the connection lives on";
}

TEST_F(GatewayTest, ServerStreamsAsDelimitedProtobuf) {
  server.Set("StreamSubmapVoxels", {.messages = {Voxels(1), "", Voxels(300)}});
  const http::HttpAnswer answer =
      client->Ask("GET", "/v1/maps/a/submaps/1/voxels", "", {{"Accept", "application/x-protobuf"}});
  EXPECT_EQ(answer.Header("Content-Type"), "application/x-protobuf-stream");
  std::istringstream stream(answer.body);
  google::protobuf::io::IstreamInputStream input(&stream);
  std::vector<std::int64_t> revisions;
  v1::StreamSubmapVoxelsResponse message;
  while (google::protobuf::util::ParseDelimitedFromZeroCopyStream(&message, &input, nullptr)) {
    revisions.push_back(message.revision());
    message.Clear();
  }
  EXPECT_EQ(revisions, (std::vector<std::int64_t>{1, 0, 300}));
}

TEST_F(GatewayTest, AStreamThatFailsAtOnceIsAPlainError) {
  server.Set("StreamSubmapVoxels", {.status = grpc::Status(grpc::NOT_FOUND, "no such submap")});
  const http::HttpAnswer answer = client->Ask("GET", "/v1/maps/a/submaps/1/voxels");
  EXPECT_EQ(answer.status, 404);
  EXPECT_EQ(At(AsJson(answer.body), "message").string_value(), "no such submap");
}

TEST_F(GatewayTest, AStreamThatFailsLaterEndsWithAnErrorLine) {
  server.Set("StreamSubmapVoxels",
             {.messages = {Voxels(1)}, .status = grpc::Status(grpc::DATA_LOSS, "a block is broken")});
  const auto lines = Lines(client->Ask("GET", "/v1/maps/a/submaps/1/voxels").body);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(At(At(AsJson(lines[1]), "error").struct_value(), "code").number_value(), 15);
}

TEST_F(GatewayTest, ABinaryStreamThatFailsLaterIsVisiblyTruncated) {
  server.Set("StreamSubmapVoxels", {.messages = {Voxels(1)}, .status = grpc::Status(grpc::DATA_LOSS, "broken")});
  const http::HttpAnswer answer =
      client->Ask("GET", "/v1/maps/a/submaps/1/voxels", "", {{"Accept", "application/x-protobuf"}});
  EXPECT_EQ(answer.status, 200);
  EXPECT_FALSE(answer.is_complete);
}

TEST_F(GatewayTest, AnEmptyStreamIsAnEmptyAnswer) {
  server.Set("StreamSubmapVoxels", {.messages = {}});
  const http::HttpAnswer answer = client->Ask("GET", "/v1/maps/a/submaps/1/voxels");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "");
  EXPECT_EQ(answer.Header("Content-Type"), "application/x-ndjson");
}

TEST_F(GatewayTest, AFileIsSentAsAFileUnlessJsonIsRequested) {
  server.Set("GetSubmapMesh", {.messages = {MeshPart("ply\n", "application/x-ply", 10), MeshPart("abc"), MeshPart(""),
                                            MeshPart("def")}});
  const http::HttpAnswer file = client->Ask("GET", "/v1/maps/home/submaps/7/mesh", "", {{"Accept", "*/*"}});
  EXPECT_EQ(file.status, 200);
  EXPECT_EQ(file.body, "ply\nabcdef");
  EXPECT_EQ(file.Header("Content-Type"), "application/x-ply");
  EXPECT_EQ(file.Header("Content-Disposition"), "attachment; filename=\"maps_home_submaps_7.ply\"");
  EXPECT_EQ(file.Header("Content-Length"), "10");
  EXPECT_EQ(client->Ask("GET", "/v1/maps/home/mesh?format=PCD&coloring=BY_CLASS").body, "ply\nabcdef");
  EXPECT_EQ(Heard<v1::GetSubmapMeshRequest>(2).coloring(), v1::GetSubmapMeshRequest::BY_CLASS);

  const auto lines =
      Lines(client->Ask("GET", "/v1/maps/home/submaps/7/mesh", "", {{"Accept", "application/json"}}).body);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(At(At(AsJson(lines[1]), "result").struct_value(), "data").string_value(), "YWJj");
}

TEST_F(GatewayTest, HeadOfAStreamHasNoBody) {
  server.Set("GetSubmapMesh", {.messages = {MeshPart("ply\n", "application/x-ply", 4)}});
  const http::HttpAnswer head = client->Ask("HEAD", "/v1/maps/home/mesh");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.Header("Content-Length"), "4");
  EXPECT_EQ(client->Ask("HEAD", "/v1/maps/a/submaps/1/voxels").status, 200);
  EXPECT_EQ(client->Ask("GET", "/healthz").body, "ok\n");
}

TEST_F(GatewayTest, FramesAsNdjsonAreAcknowledgedOneByOne) {
  server.Set("IntegrateFrames", {.acknowledge = Acknowledge});
  std::string body;
  for (int i = 1; i <= 50; ++i) body += Frame(i) + (i % 3 == 0 ? "\n" : i % 3 == 1 ? "\r\n\r\n" : "");
  const http::HttpAnswer answer =
      client->Ask("POST", "/v1/maps/a:integrateFrames", body, {{"Content-Type", "application/x-ndjson"}});
  EXPECT_EQ(answer.status, 200) << answer.body;
  const auto lines = Lines(answer.body);
  ASSERT_EQ(lines.size(), 50u);
  for (int i = 0; i < 50; ++i) {
    const auto json = AsJson(lines[i]);
    const auto& result = At(json, "result").struct_value();
    EXPECT_EQ(At(result, "sequence").string_value(), std::to_string(i + 1));
    EXPECT_EQ(At(At(result, "error").struct_value(), "message").string_value(), "maps/a")
        << "the path is in every message";
  }
}

TEST_F(GatewayTest, OneFrameAsPlainJsonOrProtobuf) {
  server.Set("IntegrateFrames", {.acknowledge = Acknowledge});
  EXPECT_EQ(Lines(client->Ask("POST", "/v1/maps/a:integrateFrames", "{\n \"sequence\": 5\n}\n").body).size(), 1u);
  v1::IntegrateFramesRequest frame;
  frame.set_sequence(9);
  const http::HttpAnswer answer = client->Ask("POST", "/v1/maps/a:integrateFrames", frame.SerializeAsString(),
                                              {{"Content-Type", "application/x-protobuf"}});
  EXPECT_NE(answer.body.find(R"("sequence":"9")"), std::string::npos) << answer.body;
}

TEST_F(GatewayTest, TheRpcLearnsThatABodyIsOneMessage) {
  server.Set("IntegrateFrames", {.acknowledge = Acknowledge});
  std::size_t num_calls = 0;
  const auto was_told = [&] { return server.WaitForCall(++num_calls).metadata.contains("dhpmap-one-message"); };
  const auto send = [&](const std::string& type, const std::string& body) {
    http::Headers headers;
    if (!type.empty()) headers.emplace_back("Content-Type", type);
    EXPECT_EQ(client->Ask("POST", "/v1/maps/a:integrateFrames", body, headers).status, 200);
    return was_told();
  };
  for (const char* type : {"", "application/json", "application/x-ndjson"}) {
    EXPECT_TRUE(send(type, Frame(1))) << type;
    EXPECT_TRUE(send(type, Frame(1) + " \r\n")) << type;
    EXPECT_FALSE(send(type, Frame(1) + Frame(2))) << type;
    EXPECT_FALSE(send(type, Frame(1) + "\n" + Frame(2) + "\n")) << type;
    EXPECT_FALSE(send(type, "")) << type;
  }
  EXPECT_TRUE(send("application/x-protobuf", "\x10\x05"));

  // With chunks the end is unknown: a single JSON value is awaited completely, a stream is passed on at once.
  const auto send_chunks = [&](const std::string& type, const std::vector<std::string>& chunks) {
    http::HttpClient fresh(gateway->port());  // an answer before the body's end ends its connection
    fresh.SendRaw(
        "POST /v1/maps/a:integrateFrames HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n"
        "Content-Type: " +
        type + "\r\n\r\n");
    for (const std::string& chunk : chunks) {
      std::ostringstream size;
      size << std::hex << chunk.size();
      fresh.SendRaw(size.str() + "\r\n" + chunk + "\r\n");
    }
    fresh.SendRaw("0\r\n\r\n");
    EXPECT_EQ(fresh.ReadAnswer().status, 200);
    return was_told();
  };
  EXPECT_TRUE(send_chunks("application/json", {"{\"seq", "uence\":1}", "\n"}));
  EXPECT_FALSE(send_chunks("application/json", {Frame(1), "\n", Frame(2)}));
  EXPECT_FALSE(send_chunks("application/x-ndjson", {Frame(1)}));
}

TEST_F(GatewayTest, FramesAsDelimitedProtobufInPieces) {
  server.Set("IntegrateFrames", {.acknowledge = Acknowledge});
  std::string body;
  for (std::size_t i = 1; i <= 20; ++i) {
    v1::IntegrateFramesRequest frame;
    frame.set_sequence(static_cast<std::int64_t>(i));
    frame.mutable_frame()->mutable_depth_camera()->mutable_depth()->set_data(std::string(i * 100, 'x'));
    AppendVarint(frame.ByteSizeLong(), &body);
    frame.AppendToString(&body);
  }
  client->SendRaw(
      "POST /v1/maps/a:integrateFrames HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n"
      "Content-Type: application/x-protobuf-stream\r\nAccept: application/x-protobuf\r\n\r\n");
  for (std::size_t at = 0; at < body.size(); at += 777) {
    const std::string piece = body.substr(at, 777);
    std::ostringstream size;
    size << std::hex << piece.size();
    client->SendRaw(size.str() + "\r\n" + piece + "\r\n");
  }
  client->SendRaw("0\r\n\r\n");
  const http::HttpAnswer answer = client->ReadAnswer();
  EXPECT_EQ(answer.status, 200);
  std::istringstream stream(answer.body);
  google::protobuf::io::IstreamInputStream input(&stream);
  v1::IntegrateFramesResponse response;
  int count = 0;
  while (google::protobuf::util::ParseDelimitedFromZeroCopyStream(&response, &input, nullptr)) {
    EXPECT_EQ(response.sequence(), ++count);
    response.Clear();
  }
  EXPECT_EQ(count, 20);
}

TEST_F(GatewayTest, AcknowledgementsArriveWhileFramesAreStillSent) {
  server.Set("IntegrateFrames", {.acknowledge = Acknowledge});
  client->SendRaw("POST /v1/maps/a:integrateFrames HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n");
  for (int i = 1; i <= 3; ++i) {
    client->SendRaw("e\r\n{\"sequence\":" + std::to_string(i) + "}\r\n");
    std::string seen;
    while (seen.find("\"sequence\":\"" + std::to_string(i) + "\"") == std::string::npos) {
      const std::string more = client->ReadSome();
      ASSERT_FALSE(more.empty());
      seen += more;
    }
  }
  client->SendRaw("0\r\n\r\n");
}

TEST_F(GatewayTest, AMalformedFrameEndsTheStreamAfterTheValidOnes) {
  server.Set("IntegrateFrames", {.acknowledge = Acknowledge});
  const http::HttpAnswer answer =
      client->Ask("POST", "/v1/maps/a:integrateFrames", Frame(1) + "\n" + Frame(2) + "\n{\"sequence\":x}\n" + Frame(4));
  EXPECT_EQ(answer.status, 200);
  const auto lines = Lines(answer.body);
  ASSERT_EQ(lines.size(), 3u) << answer.body;
  const auto error = At(AsJson(lines[2]), "error").struct_value();
  EXPECT_EQ(At(error, "code").number_value(), 3);
  EXPECT_NE(At(error, "message").string_value().find("message 3: malformed JSON: expected a number"), std::string::npos)
      << lines[2];
}

TEST_F(GatewayTest, AMalformedFirstFrameIsAPlainErrorWithoutACall) {
  const http::HttpAnswer answer = client->Ask("POST", "/v1/maps/a:integrateFrames", "[1,2]");
  EXPECT_EQ(answer.status, 400);
  EXPECT_NE(answer.body.find("message 1: malformed JSON"), std::string::npos) << answer.body;
  EXPECT_EQ(client->Ask("POST", "/v1/maps/a:integrateFrames", R"({"sequence":1)").status, 400) << "cut off";
  EXPECT_EQ(server.num_calls(), 0u);
}

TEST_F(GatewayTest, AStreamMayExceedTheBodyLimitButItsMessagesMayNot) {
  DHPMAP_SKIP_MEGABYTES();
  server.Set("IntegrateFrames", {.acknowledge = Acknowledge});
  const std::string blob(400'000, 'A');
  std::string body;
  for (int i = 1; i <= 6; ++i) {
    body += R"({"frame":{"depth_camera":{"depth":{"data":")" + blob + R"("}}},"sequence":)" + std::to_string(i) + "}\n";
  }
  ASSERT_GT(body.size(), 2 * kMaxBody_bytes);
  EXPECT_EQ(Lines(client->Ask("POST", "/v1/maps/a:integrateFrames", body).body).size(), 6u);

  const std::string too_large = R"({"map":")" + std::string(kMaxBody_bytes, 'x') + "\"}";
  const http::HttpAnswer refused =
      http::HttpClient(gateway->port()).Ask("POST", "/v1/maps/a:integrateFrames", too_large);
  EXPECT_EQ(refused.status, 413) << refused.body.substr(0, 300);
  const auto lines = Lines(
      http::HttpClient(gateway->port()).Ask("POST", "/v1/maps/a:integrateFrames", Frame(1) + "\n" + too_large).body);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(At(At(AsJson(lines[1]), "error").struct_value(), "code").number_value(), 8);
}

TEST_F(GatewayTest, TheRpcsErrorTakesPrecedence) {
  server.Set("IntegrateFrames", {.status = grpc::Status(grpc::NOT_FOUND, "no map a")});
  const http::HttpAnswer answer = client->Ask("POST", "/v1/maps/a:integrateFrames", Frame(1) + Frame(2));
  EXPECT_EQ(answer.status, 404);
}

TEST_F(GatewayTest, AClientStreamWithOneAnswer) {
  Everything response;
  response.set_i32(3);
  server.Set("Collect", {.messages = {response.SerializeAsString()}});
  const http::HttpAnswer answer = client->Ask("POST", "/test/x:collect", R"({"i32":1})");
  EXPECT_EQ(answer.Header("Content-Type"), "application/json") << "as of an RPC that does not stream";
  EXPECT_EQ(At(AsJson(answer.body), "i32").number_value(), 3);
}

TEST_F(GatewayTest, ASlowReaderSlowsTheServer) {
  DHPMAP_SKIP_MEGABYTES();
  // 200 MB could not be kept anywhere without notice; the client reads only after a while.
  const std::string big = MeshPart(std::string(1u << 20, 'm'), "x/y");
  server.Set("GetSubmapMesh", {.messages = std::vector<std::string>(200, big)});
  client->SendRaw("GET /v1/maps/a/mesh HTTP/1.1\r\nHost: localhost\r\n\r\n");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(server.num_calls(), 0u) << "the RPC still waits for the reader";
  const http::HttpAnswer answer = client->ReadAnswer();
  EXPECT_EQ(answer.body.size(), 200u << 20);
  EXPECT_TRUE(answer.is_complete);
}

TEST_F(GatewayTest, AClientThatDisconnectsCancelsItsStream) {
  DHPMAP_SKIP_MEGABYTES();
  const std::string big = MeshPart(std::string(1u << 20, 'm'), "x/y");
  server.Set("GetSubmapMesh", {.messages = std::vector<std::string>(200, big)});
  client->SendRaw("GET /v1/maps/a/mesh HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_FALSE(client->ReadSome().empty());
  client.reset();
  EXPECT_TRUE(server.WaitForCancel());
}

TEST_F(GatewayTest, AClientThatStopsWithinAMessageCancelsTheStream) {
  server.Set("IntegrateFrames", {.acknowledge = Acknowledge});
  client->SendRaw("POST /v1/maps/a:integrateFrames HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000\r\n\r\n" +
                  Frame(1));
  EXPECT_FALSE(client->ReadSome().empty());
  client.reset();
  EXPECT_TRUE(server.WaitForCancel());
}

/// An exchange without a connection.
class StreamExchangeTest : public ::testing::Test {
 protected:
  /// Calls, and the exchanges that they hold, end before the objects that they use.
  ~StreamExchangeTest() override {
    EXPECT_TRUE(responder->RunUntil([&] { return caller.WaitUntilIdle(std::chrono::milliseconds(0)); }));
  }

  std::shared_ptr<http::Exchange> Begin(const http::RequestHead& head) {
    auto request = RpcRequest::Make(head, Matched(head.method, head.target), "", 1000);
    EXPECT_TRUE(request.ok());
    return MakeStreamExchange(std::move(*request), ByteShare(&budget), {&caller, &bulk}, responder);
  }

  CannedServer server;
  ByteBudget budget{1u << 20};
  std::shared_ptr<RecordingResponder> responder = std::make_shared<RecordingResponder>();
  RpcCaller caller{server.channel()};
  Lane bulk{{}};
};

TEST_F(StreamExchangeTest, PausesTheConnectionWhileAMessageIsInFlight) {
  server.Set("IntegrateFrames", {.acknowledge = Acknowledge});
  const auto exchange = Begin(RequestHeadOf("POST", "/v1/maps/a:integrateFrames"));
  EXPECT_TRUE(exchange->OnBody(R"({"sequence":)")) << "no message yet";
  EXPECT_FALSE(exchange->OnBody("1}\n" + Frame(2)));
  ASSERT_TRUE(responder->RunUntil([&] { return responder->num_resumed > 0; }));
  EXPECT_EQ(responder->num_resumed, 1) << "once, when both have gone";
  exchange->OnBodyEnd();
  ASSERT_TRUE(responder->RunUntil([&] { return !responder->chunks.empty(); }));
  std::string answer;
  while (responder->ends.empty()) {
    answer += responder->chunks.back();
    responder->chunks.clear();
    exchange->OnWritten();
    ASSERT_TRUE(responder->RunUntil([&] { return !responder->chunks.empty() || !responder->ends.empty(); }));
  }
  EXPECT_EQ(Lines(answer).size(), 2u);
  EXPECT_EQ(responder->ends, std::vector<bool>{true});
}

TEST_F(StreamExchangeTest, LargeMessagesAreEncodedOnTheLaneAndSmallOnesDoNotWait) {
  v1::StreamSubmapVoxelsResponse large;
  large.set_revision(2);
  large.mutable_rgb()->assign(2 * kMostQuickBytes, 'x');
  server.Set("StreamSubmapVoxels", {.messages = {Voxels(1), large.SerializeAsString(), Voxels(3)}});
  testing::LanePlug plug(bulk);
  const auto exchange = Begin(RequestHeadOf("GET", "/v1/maps/a/submaps/1/voxels"));
  exchange->OnBodyEnd();
  ASSERT_TRUE(responder->RunUntil([&] { return !responder->chunks.empty(); }));
  std::string answer = std::move(responder->chunks.back());
  responder->chunks.clear();
  EXPECT_EQ(Lines(answer).size(), 1u) << "what is small";
  exchange->OnWritten();
  plug.Release();
  while (responder->ends.empty()) {
    ASSERT_TRUE(responder->RunUntil([&] { return !responder->chunks.empty() || !responder->ends.empty(); }));
    if (responder->chunks.empty()) break;
    answer += responder->chunks.back();
    responder->chunks.clear();
    exchange->OnWritten();
  }
  const auto lines = Lines(answer);
  ASSERT_EQ(lines.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(At(At(AsJson(lines[i]), "result").struct_value(), "revision").string_value(), std::to_string(i + 1));
  }
}

TEST_F(StreamExchangeTest, OnePartOfTheAnswerIsInFlightAtATime) {
  server.Set("StreamSubmapVoxels", {.messages = std::vector<std::string>(20, Voxels(1))});
  const auto exchange = Begin(RequestHeadOf("GET", "/v1/maps/a/submaps/1/voxels"));
  exchange->OnBodyEnd();
  std::size_t num_parts = 0;
  std::string answer;
  while (true) {
    ASSERT_TRUE(responder->RunUntil([&] { return responder->chunks.size() > num_parts || !responder->ends.empty(); }));
    if (!responder->ends.empty()) break;
    ASSERT_EQ(responder->chunks.size(), ++num_parts);
    answer += responder->chunks.back();
    exchange->OnWritten();
  }
  EXPECT_EQ(Lines(answer).size(), 20u);
  EXPECT_EQ(responder->heads.size(), 1u);
  EXPECT_TRUE(responder->replies.empty());
}

TEST_F(StreamExchangeTest, AClosedConnectionGetsNoFurtherCallsAndFreesItsBytes) {
  server.Set("StreamSubmapVoxels", {.messages = std::vector<std::string>(50, Voxels(1))});
  auto exchange = Begin(RequestHeadOf("GET", "/v1/maps/a/submaps/1/voxels"));
  exchange->OnBodyEnd();
  ASSERT_TRUE(responder->RunUntil([&] { return !responder->chunks.empty(); }));
  exchange->OnClosed();
  const std::weak_ptr<http::Exchange> left = exchange;
  exchange.reset();
  EXPECT_TRUE(responder->RunUntil([&] { return left.expired(); })) << "the RPC ends";
  EXPECT_EQ(responder->chunks.size(), 1u);
  EXPECT_TRUE(responder->ends.empty());
  EXPECT_EQ(budget.used_bytes(), 0u);
}

TEST(StreamStates, NothingFollowsTheEnd) {
  for (const Sending next : {Sending::kIdle, Sending::kBusy, Sending::kBusyHeld, Sending::kEnded}) {
    EXPECT_FALSE(IsLegal(Sending::kEnded, next));
  }
  EXPECT_FALSE(IsLegal(Sending::kBusy, Sending::kBusy)) << "one message at a time";
  EXPECT_FALSE(IsLegal(Receiving::kBusy, Receiving::kDone)) << "the end of reads comes before the status";
  EXPECT_FALSE(IsLegal(Receiving::kDone, Receiving::kIdle));
  EXPECT_FALSE(IsLegal(Answering::kEnded, Answering::kBusy));
  EXPECT_FALSE(IsLegal(Answering::kNone, Answering::kBusy)) << "the head comes first";
}

}  // namespace
}  // namespace dhpmap::gateway

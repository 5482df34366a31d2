// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/gateway.h"

#include <random>

#include "dhpmap/v1/map_service.pb.h"
#include "tests/support/eventually.h"
#include "tests/unit/server/gateway/gateway_fixture.h"

namespace dhpmap::gateway {
namespace {

using namespace std::string_view_literals;

TEST_F(GatewayTest, ManyRequestsOnOneConnection) {
  for (int i = 0; i < 200; ++i) {
    ASSERT_EQ(client->Ask("GET", "/v1/maps").status, 200);
    ASSERT_EQ(client->Ask("POST", "/v1/nothing", "{\"a\":1}").status, 404) << "its body is read away";
  }
}

TEST_F(GatewayTest, PipelinedRequestsAreAnsweredInOrder) {
  client->SendRaw(
      "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\nGET /v1/maps/a HTTP/1.1\r\nHost: localhost\r\n\r\n"
      "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Length: 2\r\n\r\n{}GET /nothing HTTP/1.1\r\nHost: "
      "localhost\r\n\r\n");
  EXPECT_EQ(client->ReadAnswer().body, "ok\n");
  EXPECT_NE(client->ReadAnswer().body.find("revision"), std::string::npos);
  EXPECT_EQ(client->ReadAnswer().status, 200);
  EXPECT_EQ(client->ReadAnswer().status, 404);
}

TEST_F(GatewayTest, RespectsConnectionCloseAndHttp10) {
  EXPECT_EQ(client->Ask("GET", "/healthz", "", {{"Connection", "close"}}).Header("Connection"), "close");
  EXPECT_TRUE(client->IsClosedByServer());
  http::HttpClient old(gateway->port());
  old.SendRaw("GET /v1/maps/a/submaps/1/voxels HTTP/1.0\r\n\r\n");
  const http::HttpAnswer answer = old.ReadAnswer();
  EXPECT_EQ(answer.status, 200);
  EXPECT_FALSE(answer.was_chunked);
  EXPECT_NE(answer.body.find("result"), std::string::npos);
}

TEST_F(GatewayTest, ABodyInSmallChunksIsJoined) {
  client->SendRaw("POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n");
  for (const char c : std::string(R"({"map_id":"home"})")) client->SendRaw(std::string("1;x=y\r\n") + c + "\r\n");
  client->SendRaw("0\r\nTrailer: t\r\n\r\n");
  EXPECT_EQ(client->ReadAnswer().status, 200);
  EXPECT_EQ(Heard<v1::CreateMapRequest>().map_id(), "home");
}

TEST_F(GatewayTest, ExpectContinueIsAnsweredOnlyIfTheBodyIsWanted) {
  client->SendRaw("POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\n");
  EXPECT_EQ(client->ReadAnswer().status, 100);
  client->SendRaw("{}");
  EXPECT_EQ(client->ReadAnswer().status, 200);
  client->SendRaw(
      "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: 104857600\r\n\r\n");
  EXPECT_EQ(client->ReadAnswer().status, 413);
}

TEST_F(GatewayTest, ATooLargeBodyIsRefusedBeforeItIsRead) {
  client->SendRaw("POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Length: 104857600\r\n\r\n{");
  const http::HttpAnswer answer = client->ReadAnswer();
  EXPECT_EQ(answer.status, 413);
  EXPECT_EQ(At(AsJson(answer.body), "code").number_value(), 8);
  EXPECT_EQ(answer.Header("Connection"), "close");
}

TEST_F(GatewayTest, AClientThatSendsAHundredMegabytesReceivesTheRefusal) {
  DHPMAP_SKIP_MEGABYTES();
  for (const bool is_chunked : {false, true}) {
    http::HttpClient sender(gateway->port());
    const std::size_t size = 100u << 20;
    sender.SendRaw(
        std::string("POST /v1/maps HTTP/1.1\r\nHost: localhost\r\n") +
        (is_chunked ? "Transfer-Encoding: chunked\r\n\r\n" : "Content-Length: " + std::to_string(size) + "\r\n\r\n"));
    const std::string megabyte(1u << 20, 'x');
    for (std::size_t sent = 0; sent < size; sent += megabyte.size()) {
      if (!sender.SendRaw(is_chunked ? "100000\r\n" + megabyte + "\r\n" : megabyte)) break;
    }
    const http::HttpAnswer answer = sender.ReadAnswer();
    EXPECT_EQ(answer.status, 413) << is_chunked << answer.body;
  }
}

TEST_F(GatewayTest, MalformedRequestsAreAnsweredAndTheConnectionClosed) {
  const std::string long_value(40'000, 'x');
  const std::pair<std::string, int> cases[] = {
      {"GARBAGE\r\n\r\n", 400},
      {"GET / HTTP/9.9\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nno colon\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: x\r\n\r\n", 400},
      {"POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n{}", 400},
      {"POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n{}\r\n", 400},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + long_value + "\r\n\r\n", 431},
      {"GET /" + long_value + " HTTP/1.1\r\nHost: localhost\r\n\r\n", 431},
      {std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 tls hello\r\n\r\n"sv), 400},
  };
  for (const auto& [request, status] : cases) {
    http::HttpClient raw(gateway->port());
    raw.SendRaw(request);
    const http::HttpAnswer answer = raw.ReadAnswer();
    EXPECT_EQ(answer.status, status) << request.substr(0, 60);
    AsJson(answer.body);
    EXPECT_TRUE(raw.IsClosedByServer()) << request.substr(0, 60);
  }
  EXPECT_EQ(client->Ask("GET", "nonsense").status, 400);
  EXPECT_EQ(client->Ask("GET", "/v1/maps/%zz").status, 404);
}

/// For any input the server answers or closes the connection, and continues serving others.
TEST_F(GatewayTest, MutatedRequestsNeverCrashIt) {
  const std::string seeds[] = {
      "POST /v1/maps/a:integrateFrames?x=%20 HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
      "Content-Length: 14\r\nX-Timeout-S: 1\r\n\r\n{\"sequence\":1}",
      "PATCH /v1/maps/a/submaps/1 HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
      "15\r\n{\"display_name\":\"x\"}\n\r\n0\r\n\r\n",
      "GET /v1/maps/a/submaps?class_ids=1,2&sphere.radius_m=2 HTTP/1.1\r\nHost: localhost\r\nAccept: a/b;q=0.1, "
      "application/x-protobuf\r\nExpect: 100-continue\r\n\r\n",
  };
  std::mt19937 random(7);
  int num_answered = 0;
  for (int round = 0; round < 600; ++round) {
    std::string request = seeds[round % 3];
    const int num_changes = 1 + static_cast<int>(random() % 5);
    for (int i = 0; i < num_changes && !request.empty(); ++i) {
      const std::size_t at = random() % request.size();
      switch (random() % 4) {
        case 0: request[at] = static_cast<char>(random()); break;
        case 1: request.erase(at, 1 + random() % 10); break;
        case 2: request.insert(at, request.substr(random() % request.size(), random() % 20)); break;
        default: request.insert(at, 1, "\r\n:/%{}\"\x80"[random() % 9]);
      }
    }
    http::HttpClient raw(gateway->port());
    raw.SendRaw(request);
    raw.CloseSending();
    if (raw.ReadAnswer().status != 0) ++num_answered;
  }
  EXPECT_GT(num_answered, 100);
  EXPECT_EQ(client->Ask("GET", "/healthz").status, 200);
}

TEST_F(GatewayTest, AnswersCarryADate) {
  const std::string date = client->Ask("GET", "/healthz").Header("Date");
  EXPECT_EQ(date.size(), 29u) << date;
  EXPECT_EQ(date.substr(date.size() - 4), " GMT");
}

TEST(GatewayBudget, BeyondTheBytesInFlightTheAnswerIs429AtOnce) {
  CannedServer server;
  GatewayOptions options;
  options.address = "127.0.0.1:0";
  options.max_body_bytes = 1u << 20;
  options.inflight = std::make_shared<ByteBudget>(1u << 20);
  auto gateway = Gateway::Start(options, server.channel(), {});
  ASSERT_TRUE(gateway.ok());
  const auto refused = [&] {
    http::HttpClient client((*gateway)->port());
    client.SendRaw("POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nContent-Length: 300000\r\n\r\n{");
    const http::HttpAnswer answer = client.ReadAnswer();
    EXPECT_NE(answer.body.find("TOO_MANY_BYTES"), std::string::npos) << answer.body;
    return answer.status;
  };
  {
    http::HttpClient unfinished((*gateway)->port());
    unfinished.SendRaw(
        "POST /v1/maps HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: 900000\r\n\r\n");
    ASSERT_EQ(unfinished.ReadAnswer().status, 100);
    EXPECT_EQ(refused(), 429);
    http::HttpClient small((*gateway)->port());
    EXPECT_EQ(small.Ask("POST", "/v1/maps", "{}").status, 200) << "there is room for a few bytes";
    EXPECT_EQ(small.Ask("GET", "/healthz").status, 200);
  }
  http::HttpClient later((*gateway)->port());
  EXPECT_TRUE(testing::Eventually([&] {
    return later.Ask("POST", "/v1/maps", "{" + std::string(300'000, ' ') + "}").status == 200;
  })) << "the client that left has given its bytes back";
}

TEST(GatewayBudget, AStreamedBodyIsCountedAsItArrives) {
  CannedServer server;
  GatewayOptions options;
  options.address = "127.0.0.1:0";
  options.inflight = std::make_shared<ByteBudget>(1u << 20);
  auto gateway = Gateway::Start(options, server.channel(), {});
  ASSERT_TRUE(gateway.ok());
  http::HttpClient client((*gateway)->port());
  client.SendRaw(
      "POST /v1/maps/a:integrateFrames HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3000000\r\n\r\n{\"frame\":\"" +
      std::string(2'000'000, 'x'));
  const http::HttpAnswer answer = client.ReadAnswer();
  EXPECT_EQ(answer.status, 429);
  EXPECT_NE(answer.body.find("TOO_MANY_BYTES"), std::string::npos) << answer.body;
}

TEST_F(GatewayTest, AShutdownWaitsForShortCallsAndEndsLongOnes) {
  server.Set("GetMap", {.hang = true});
  client->SendRaw("GET /v1/maps/a HTTP/1.1\r\nHost: localhost\r\n\r\n");
  server.WaitForCall();
  http::HttpClient idle(gateway->port());
  EXPECT_EQ(idle.Ask("GET", "/healthz").status, 200);
  gateway->Shutdown(0.1);
  EXPECT_TRUE(server.WaitForCancel());
  EXPECT_TRUE(idle.IsClosedByServer());
  EXPECT_EQ(http::HttpClient(gateway->port()).Ask("GET", "/healthz").status, 0) << "nothing is accepted any more";
}

TEST(Gateway, ReportsWhyItCannotListen) {
  CannedServer server;
  GatewayOptions options;
  options.address = "127.0.0.1:0";
  auto first = Gateway::Start(options, server.channel(), {});
  ASSERT_TRUE(first.ok());
  options.address = "127.0.0.1:" + std::to_string((*first)->port());
  const auto second = Gateway::Start(options, server.channel(), {});
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.status().code(), StatusCode::kUnavailable);
  EXPECT_NE(second.status().message().find(options.address), std::string::npos);
  for (const char* address : {"nonsense", "127.0.0.1", "127.0.0.1:x", "127.0.0.1:70000", "no.such.host:80", ""}) {
    options.address = address;
    const auto bad = Gateway::Start(options, server.channel(), {});
    ASSERT_FALSE(bad.ok()) << address;
    EXPECT_EQ(bad.status().code(), StatusCode::kInvalidArgument) << address;
  }
}

}  // namespace
}  // namespace dhpmap::gateway

// SPDX-License-Identifier: BSD-3-Clause
#include <random>

#include "dhpmap/v1/map_service.pb.h"
#include "server/rest/media_type.h"
#include "server/rest/stream_encoder.h"
#include "tests/unit/server/rest/gateway_fixture.h"

namespace dhpmap::rest {
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
      "GET /healthz HTTP/1.1\r\nHost: x\r\n\r\nGET /v1/maps/a HTTP/1.1\r\nHost: x\r\n\r\n"
      "POST /v1/maps HTTP/1.1\r\nContent-Length: 2\r\n\r\n{}GET /nothing HTTP/1.1\r\n\r\n");
  EXPECT_EQ(client->ReadAnswer().body, "ok\n");
  EXPECT_NE(client->ReadAnswer().body.find("revision"), std::string::npos);
  EXPECT_EQ(client->ReadAnswer().status, 200);
  EXPECT_EQ(client->ReadAnswer().status, 404);
}

TEST_F(GatewayTest, HonoursConnectionCloseAndHttp10) {
  EXPECT_EQ(client->Ask("GET", "/healthz", "", {{"Connection", "close"}}).Header("Connection"), "close");
  EXPECT_TRUE(client->IsClosedByServer());
  HttpClient old(gateway->port());
  old.SendRaw("GET /v1/maps/a/submaps/1:voxels HTTP/1.0\r\n\r\n");
  const HttpAnswer answer = old.ReadAnswer();
  EXPECT_EQ(answer.status, 200);
  EXPECT_FALSE(answer.was_chunked);
  EXPECT_NE(answer.body.find("result"), std::string::npos);
}

TEST_F(GatewayTest, ABodyInSmallChunksIsPutTogether) {
  client->SendRaw("POST /v1/maps HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n");
  for (const char c : std::string(R"({"map_id":"home"})")) client->SendRaw(std::string("1;x=y\r\n") + c + "\r\n");
  client->SendRaw("0\r\nTrailer: t\r\n\r\n");
  EXPECT_EQ(client->ReadAnswer().status, 200);
  EXPECT_EQ(Heard<v1::CreateMapRequest>().map_id(), "home");
}

TEST_F(GatewayTest, ExpectContinueIsAnsweredOnlyIfTheBodyIsWanted) {
  client->SendRaw("POST /v1/maps HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\n");
  EXPECT_EQ(client->ReadAnswer().status, 100);
  client->SendRaw("{}");
  EXPECT_EQ(client->ReadAnswer().status, 200);
  client->SendRaw("POST /v1/maps HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: 104857600\r\n\r\n");
  EXPECT_EQ(client->ReadAnswer().status, 413);
}

TEST_F(GatewayTest, ABodyThatIsTooLargeIsRefusedBeforeItIsRead) {
  client->SendRaw("POST /v1/maps HTTP/1.1\r\nContent-Length: 104857600\r\n\r\n{");
  const HttpAnswer answer = client->ReadAnswer();
  EXPECT_EQ(answer.status, 413);
  EXPECT_EQ(At(AsJson(answer.body), "code").number_value(), 8);
  EXPECT_EQ(answer.Header("Connection"), "close");
}

TEST_F(GatewayTest, AClientThatSendsAHundredMegabytesGetsToSeeTheRefusal) {
  DHPMAP_SKIP_MEGABYTES();
  for (const bool is_chunked : {false, true}) {
    HttpClient sender(gateway->port());
    const std::size_t size = 100u << 20;
    sender.SendRaw(
        std::string("POST /v1/maps HTTP/1.1\r\n") +
        (is_chunked ? "Transfer-Encoding: chunked\r\n\r\n" : "Content-Length: " + std::to_string(size) + "\r\n\r\n"));
    const std::string megabyte(1u << 20, 'x');
    for (std::size_t sent = 0; sent < size; sent += megabyte.size()) {
      if (!sender.SendRaw(is_chunked ? "100000\r\n" + megabyte + "\r\n" : megabyte)) break;
    }
    EXPECT_EQ(sender.ReadAnswer().status, 413) << is_chunked;
  }
}

TEST_F(GatewayTest, MalformedRequestsAreAnsweredAndTheConnectionClosed) {
  const std::string long_value(40'000, 'x');
  const std::pair<std::string, int> cases[] = {
      {"GARBAGE\r\n\r\n", 400},
      {"GET / HTTP/9.9\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\nno colon\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\nContent-Length: x\r\n\r\n", 400},
      {"POST /v1/maps HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n{}", 400},
      {"POST /v1/maps HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n{}\r\n", 400},
      {"GET / HTTP/1.1\r\nX: " + long_value + "\r\n\r\n", 431},
      {"GET /" + long_value + " HTTP/1.1\r\n\r\n", 431},
      {std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 tls hello\r\n\r\n"sv), 400},
  };
  for (const auto& [request, status] : cases) {
    HttpClient raw(gateway->port());
    raw.SendRaw(request);
    const HttpAnswer answer = raw.ReadAnswer();
    EXPECT_EQ(answer.status, status) << request.substr(0, 60);
    AsJson(answer.body);
    EXPECT_TRUE(raw.IsClosedByServer()) << request.substr(0, 60);
  }
  EXPECT_EQ(client->Ask("GET", "nonsense").status, 400);
  EXPECT_EQ(client->Ask("GET", "/v1/maps/%zz").status, 404);
}

/// Whatever arrives, the server answers something or closes, and goes on serving others.
TEST_F(GatewayTest, MutatedRequestsNeverBringItDown) {
  const std::string seeds[] = {
      "POST /v1/maps/a:integrateFrames?x=%20 HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
      "Content-Length: 14\r\nX-Timeout-S: 1\r\n\r\n{\"sequence\":1}",
      "PATCH /v1/maps/a/submaps/1 HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"
      "15\r\n{\"display_name\":\"x\"}\n\r\n0\r\n\r\n",
      "GET /v1/maps/a/submaps?class_ids=1,2&near.radius_m=2 HTTP/1.1\r\nHost: localhost\r\nAccept: a/b;q=0.1, "
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
    HttpClient raw(gateway->port());
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

TEST(MediaType, KnowsWhatBodiesMayBe) {
  EXPECT_EQ(FormatOfContentType(""), BodyFormat::kJson);
  EXPECT_EQ(FormatOfContentType("application/x-www-form-urlencoded"), BodyFormat::kJson);
  EXPECT_EQ(FormatOfContentType("application/json ; charset=utf-8"), BodyFormat::kJson);
  EXPECT_EQ(FormatOfContentType("application/x-protobuf"), BodyFormat::kProtobuf);
  EXPECT_EQ(FormatOfContentType("application/x-protobuf-stream"), BodyFormat::kDelimitedProtobuf);
  EXPECT_FALSE(FormatOfContentType("multipart/form-data; boundary=x"));
}

TEST(MediaType, ChoosesAmongWhatIsAccepted) {
  EXPECT_EQ(FormatOfAccept(""), AnswerFormat::kAny);
  EXPECT_EQ(FormatOfAccept("*/*"), AnswerFormat::kAny);
  EXPECT_EQ(FormatOfAccept("text/html,application/xml;q=0.9,*/*;q=0.8"), AnswerFormat::kAny);
  EXPECT_EQ(FormatOfAccept("application/json"), AnswerFormat::kJson);
  EXPECT_EQ(FormatOfAccept("application/json;q=0.5, application/x-protobuf"), AnswerFormat::kProtobuf);
  EXPECT_EQ(FormatOfAccept("application/x-protobuf;q=0, application/x-ndjson;q=0.1"), AnswerFormat::kJson);
  EXPECT_EQ(FormatOfAccept("application/octet-stream"), AnswerFormat::kAny);
}

TEST(MediaType, GivesFilesTheirExtension) {
  EXPECT_EQ(ExtensionOf("application/x-ply"), "ply");
  EXPECT_EQ(ExtensionOf("model/gltf-binary"), "bin");
  EXPECT_EQ(ExtensionOf("text/csv; charset=utf-8"), "csv");
  EXPECT_EQ(ExtensionOf("application/../x"), "bin");
  EXPECT_EQ(ExtensionOf(""), "bin");
}

}  // namespace
}  // namespace dhpmap::rest

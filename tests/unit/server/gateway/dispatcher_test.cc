// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/dispatcher.h"

#include "server/base/lane.h"
#include "server/gateway/rpc_call.h"
#include "tests/unit/server/gateway/gateway_fixture.h"
#include "tests/unit/server/gateway/recording_responder.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

TEST_F(GatewayTest, UnknownPathsMethodsAndTypes) {
  const http::HttpAnswer unknown = client->Ask("GET", "/v1/nothing/here");
  EXPECT_EQ(unknown.status, 404);
  EXPECT_EQ(At(AsJson(unknown.body), "code").number_value(), 5);
  EXPECT_EQ(client->Ask("POST", "/v1/maps/a:finishMaping", "{}").status, 404) << "misspelt verb";

  const http::HttpAnswer wrong = client->Ask("PUT", "/v1/maps/a");
  EXPECT_EQ(wrong.status, 405);
  EXPECT_EQ(wrong.Header("Allow"), "DELETE, GET, HEAD, PATCH");
  const http::HttpAnswer options = client->Ask("OPTIONS", "/v1/maps");
  EXPECT_EQ(options.status, 204);
  EXPECT_EQ(options.Header("Allow"), "GET, HEAD, POST");

  EXPECT_EQ(client->Ask("POST", "/v1/maps", "<map/>", {{"Content-Type", "text/xml"}}).status, 415);
  EXPECT_EQ(client->Ask("POST", "/v1/maps", "{}", {{"Content-Encoding", "gzip"}}).status, 415);
  EXPECT_EQ(client->Ask("POST", "/v1/maps", "{}", {{"Content-Type", "application/x-protobuf-stream"}}).status, 415);
  EXPECT_EQ(client->Ask("GET", "/v1/maps", "{}").status, 400) << "a GET with a body";
  EXPECT_EQ(server.num_calls(), 0u);
}

TEST_F(GatewayTest, RequestsOfForeignWebPagesAreRefused) {
  const auto ask = [&](const char* method, const char* origin) {
    return client->Ask(method, "/v1/maps", "", {{"Origin", origin}}).status;
  };
  EXPECT_EQ(ask("POST", "http://evil.example"), 403);
  EXPECT_EQ(ask("POST", "null"), 403);
  EXPECT_EQ(ask("POST", "http://localhost:3000"), 403) << "another server on this machine";
  EXPECT_EQ(ask("POST", "http://localhost"), 200) << "the server's own pages";
  EXPECT_EQ(ask("GET", "http://evil.example"), 200) << "the browser keeps the answer from the page";
}

TEST_F(GatewayTest, AForeignPageThatUsesItsOwnHostNameIsRefused) {
  client->SendRaw("DELETE /v1/maps/a HTTP/1.1\r\nHost: evil.example\r\nOrigin: http://evil.example\r\n\r\n");
  const http::HttpAnswer answer = client->ReadAnswer();
  EXPECT_EQ(answer.status, 421);
  EXPECT_NE(answer.body.find("HOST_NOT_ALLOWED"), std::string::npos);
  EXPECT_EQ(server.num_calls(), 0u);
}

/// A dispatcher without a connection.
class DispatcherTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kMaxBody_bytes = 1000, kBudget_bytes = 1500;

  DispatcherTest()
      : dispatcher(HttpRuleRouter::FromLinkedServices().value(), {&caller, &bulk}, {}, kMaxBody_bytes,
                   std::make_shared<ByteBudget>(kBudget_bytes)) {}

  /// The immediate reply, without an exchange.
  http::Response Refused(const http::RequestHead& head) {
    const auto responder = std::make_shared<RecordingResponder>();
    EXPECT_EQ(dispatcher.Begin(head, responder), nullptr) << head.target;
    EXPECT_EQ(responder->replies.size(), 1u) << head.target;
    return responder->replies.empty() ? http::Response() : responder->replies.front();
  }

  CannedServer server;
  RpcCaller caller{server.channel()};
  Lane bulk{{}};
  Dispatcher dispatcher;
};

TEST_F(DispatcherTest, RepliesOrMakesAnExchange) {
  EXPECT_EQ(Refused(RequestHeadOf("GET", "/healthz")).status, 200);
  EXPECT_EQ(Refused(RequestHeadOf("HEAD", "/openapi.json?x=y")).status, 200);
  EXPECT_EQ(Refused(RequestHeadOf("GET", "nonsense")).status, 400);
  EXPECT_EQ(Refused(RequestHeadOf("GET", "/nothing")).status, 404);
  EXPECT_EQ(Refused(RequestHeadOf("DELETE", "/healthz")).status, 405);
  EXPECT_EQ(Refused(RequestHeadOf("GET", "/v1/maps?a=%")).status, 400);
  EXPECT_EQ(Refused(RequestHeadOf("POST", "/v1/maps", {}, kMaxBody_bytes + 1)).status, 413);
  for (const char* target : {"/v1/maps", "http://localhost/v1/maps/a", "/v1/maps/a/mesh"}) {
    const auto responder = std::make_shared<RecordingResponder>();
    EXPECT_NE(dispatcher.Begin(RequestHeadOf("GET", target), responder), nullptr) << target;
    EXPECT_TRUE(responder->replies.empty()) << target;
  }
}

TEST_F(DispatcherTest, ErrorsHaveTheRequestedFormat) {
  const http::Response binary = Refused(RequestHeadOf("GET", "/nothing", {{"Accept", "application/x-protobuf"}}));
  EXPECT_EQ(http::FindHeader(binary.headers, "content-type"), "application/x-protobuf");
  EXPECT_EQ(AsJson(Refused(RequestHeadOf("GET", "/nothing")).body).fields().at("code").number_value(), 5);
  const http::Response malformed = dispatcher.ErrorAnswer(InvalidArgument("no HTTP").WithReason("MALFORMED_HTTP"));
  EXPECT_EQ(malformed.status, 400);
  AsJson(malformed.body);
}

TEST_F(DispatcherTest, ABodyReservesItsAnnouncedBytesAndReleasesThem) {
  const http::RequestHead large = RequestHeadOf("POST", "/v1/maps", {}, kMaxBody_bytes);
  auto first = dispatcher.Begin(large, std::make_shared<RecordingResponder>());
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(Refused(large).status, 429);
  EXPECT_NE(dispatcher.Begin(RequestHeadOf("POST", "/v1/maps", {}, 500), std::make_shared<RecordingResponder>()),
            nullptr)
      << "there is room for it";
  first.reset();
  EXPECT_NE(dispatcher.Begin(large, std::make_shared<RecordingResponder>()), nullptr);
}

TEST_F(DispatcherTest, AForeignPageMayOnlyRead) {
  http::RequestHead head = RequestHeadOf("GET", "/v1/maps");
  head.is_from_foreign_page = true;
  EXPECT_NE(dispatcher.Begin(head, std::make_shared<RecordingResponder>()), nullptr);
  head.method = "POST";
  EXPECT_EQ(Refused(head).status, 403);
  head.target = "/nothing";
  EXPECT_EQ(Refused(head).status, 404);
}

}  // namespace
}  // namespace dhpmap::gateway

// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/allowed_origins.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "server/base/lane.h"
#include "server/gateway/dispatcher.h"
#include "server/gateway/rpc_call.h"
#include "tests/unit/server/gateway/canned_server.h"
#include "tests/unit/server/gateway/recording_responder.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

constexpr char kFleet[] = "https://fleet.example:8443";

/// A dispatcher that pages of kFleet may use.
class AllowedOriginsTest : public ::testing::Test {
 protected:
  /// gRPC's thread may hold an exchange for a moment after its answer, and with it the dispatcher's bytes.
  ~AllowedOriginsTest() override {
    exchange.reset();
    EXPECT_TRUE(caller.WaitUntilIdle(std::chrono::minutes(1)));
  }

  static http::RequestHead From(const std::string& origin, std::string method, std::string target,
                                http::Headers headers = {}) {
    headers.emplace_back("Origin", origin);
    http::RequestHead head = RequestHeadOf(std::move(method), std::move(target), std::move(headers));
    head.is_from_foreign_page = true;
    return head;
  }
  http::Response Answered(const http::RequestHead& head) {
    const auto responder = std::make_shared<RecordingResponder>();
    exchange = dispatcher.Begin(head, responder);
    if (exchange) exchange->OnBodyEnd();
    EXPECT_TRUE(responder->RunUntil([&] { return !responder->replies.empty(); })) << head.target;
    return responder->replies.empty() ? http::Response() : responder->replies.front();
  }
  static std::string Says(const http::Response& response, std::string_view header) {
    return std::string(http::FindHeader(response.headers, header));
  }

  CannedServer server;
  RpcCaller caller{server.channel()};
  Lane bulk{{}};
  Dispatcher dispatcher{
      HttpRuleRouter::FromLinkedServices().value(),     {&caller, &bulk}, {}, 1000, std::make_shared<ByteBudget>(1500),
      AllowedOrigins({kFleet, "http://localhost:3000"})};
  std::shared_ptr<http::Exchange> exchange;
};

TEST_F(AllowedOriginsTest, ABrowserLearnsWhatAnAllowedPageMaySend) {
  const http::Headers asks = {{"Access-Control-Request-Method", "POST"},
                              {"Access-Control-Request-Headers", "authorization,content-type"},
                              {"Access-Control-Request-Private-Network", "true"}};
  const http::Response preflight = Answered(From(kFleet, "OPTIONS", "/v1/maps", asks));
  EXPECT_EQ(preflight.status, 204);
  EXPECT_EQ(Says(preflight, "Access-Control-Allow-Origin"), kFleet);
  EXPECT_EQ(Says(preflight, "Access-Control-Allow-Methods"), "GET, HEAD, POST");
  EXPECT_NE(Says(preflight, "Access-Control-Allow-Headers").find("Authorization"), std::string::npos);
  EXPECT_EQ(Says(preflight, "Access-Control-Allow-Private-Network"), "true");
  EXPECT_EQ(Says(preflight, "Vary"), "Origin");
  EXPECT_EQ(Says(preflight, "Access-Control-Allow-Credentials"), "") << "never with cookies";
  EXPECT_EQ(Says(Answered(From(kFleet, "OPTIONS", "/metrics", asks)), "Access-Control-Allow-Methods"), "GET, HEAD");
  for (const char* origin : {"https://fleet.example", "https://fleet.example:8443.evil.example", "null",
                             "http://fleet.example:8443", "https://FLEET.example:8443", ""}) {
    const http::Response foreign = Answered(From(origin, "OPTIONS", "/v1/maps", asks));
    EXPECT_EQ(foreign.status, 204) << origin;
    EXPECT_EQ(Says(foreign, "Access-Control-Allow-Origin"), "") << origin;
    EXPECT_EQ(Says(foreign, "Vary"), "Origin") << origin;
  }
  EXPECT_EQ(server.num_calls(), 0u);
}

TEST_F(AllowedOriginsTest, AnAllowedPageReadsAnswersErrorsAndHeaders) {
  const http::Response maps = Answered(From(kFleet, "GET", "/v1/maps"));
  EXPECT_EQ(maps.status, 200);
  EXPECT_EQ(Says(maps, "Access-Control-Allow-Origin"), kFleet);
  EXPECT_NE(Says(maps, "Access-Control-Expose-Headers").find("ETag"), std::string::npos);
  EXPECT_EQ(Answered(From("http://localhost:3000", "POST", "/v1/maps")).status, 200) << "and may write";
  EXPECT_EQ(Says(Answered(From(kFleet, "GET", "/nothing")), "Access-Control-Allow-Origin"), kFleet);
  EXPECT_EQ(Says(Answered(From(kFleet, "GET", "/healthz")), "Access-Control-Allow-Origin"), kFleet);
  const http::Response foreign = Answered(From("https://evil.example", "GET", "/v1/maps"));
  EXPECT_EQ(Says(foreign, "Access-Control-Allow-Origin"), "");
  EXPECT_EQ(Answered(From("https://evil.example", "POST", "/v1/maps")).status, 403);
  const auto twice = From(kFleet, "POST", "/v1/maps", {{"Origin", kFleet}});
  EXPECT_EQ(Answered(twice).status, 403) << "a browser says it once";
  EXPECT_EQ(Says(Answered(RequestHeadOf("GET", "/healthz")), "Vary"), "Origin") << "caches must not mix them up";
}

TEST_F(AllowedOriginsTest, AnAllowedPageReadsStreamsToo) {
  const auto responder = std::make_shared<RecordingResponder>();
  exchange = dispatcher.Begin(From(kFleet, "GET", "/v1/maps/a:watch", {{"Accept", "text/event-stream"}}), responder);
  ASSERT_NE(exchange, nullptr);
  exchange->OnBodyEnd();
  ASSERT_TRUE(responder->RunUntil([&] { return !responder->heads.empty() || !responder->replies.empty(); }));
  const http::Response& head = responder->heads.empty() ? responder->replies.front() : responder->heads.front();
  EXPECT_EQ(Says(head, "Access-Control-Allow-Origin"), kFleet);
  exchange->OnClosed();
  const std::weak_ptr left = std::exchange(exchange, nullptr);
  EXPECT_TRUE(responder->RunUntil([&] { return left.expired(); })) << "what is posted holds it";
}

TEST_F(AllowedOriginsTest, WithoutOriginsNoCorsHeadersAreSent) {
  const Dispatcher closed(HttpRuleRouter::FromLinkedServices().value(), {&caller, &bulk}, {}, 1000,
                          std::make_shared<ByteBudget>(1500));
  const auto responder = std::make_shared<RecordingResponder>();
  EXPECT_EQ(closed.Begin(From(kFleet, "GET", "/healthz"), responder), nullptr);
  ASSERT_EQ(responder->replies.size(), 1u);
  for (const auto& [name, value] : responder->replies[0].headers) {
    EXPECT_FALSE(name == "Vary" || name.starts_with("Access-Control")) << name << value;
  }
}

}  // namespace
}  // namespace dhpmap::gateway

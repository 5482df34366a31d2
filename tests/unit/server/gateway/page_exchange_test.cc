// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/page_exchange.h"

#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <utility>

#include "server/base/byte_budget.h"
#include "server/base/lane.h"
#include "server/gateway/dispatcher.h"
#include "server/gateway/rpc_call.h"
#include "tests/support/lane_plug.h"
#include "tests/unit/server/gateway/gateway_fixture.h"
#include "tests/unit/server/gateway/recording_responder.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

TEST_F(GatewayTest, SlowMetricsDelayNoOtherRequest) {
  std::promise<void> begun, release;
  GatewayOptions options;
  options.address = "127.0.0.1:0";
  GatewayHooks hooks;
  hooks.metrics_text = [&] {
    begun.set_value();
    release.get_future().wait();
    return std::string("dhpmap_up 2\n");
  };
  const auto slow = Gateway::Start(options, server.channel(), hooks);
  ASSERT_TRUE(slow.ok()) << slow.status().message();
  http::HttpClient scraper((*slow)->port()), other((*slow)->port());
  EXPECT_TRUE(scraper.SendRaw("GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  begun.get_future().wait();
  EXPECT_EQ(other.Ask("GET", "/healthz").status, 200);
  EXPECT_EQ(other.Ask("GET", "/v1/maps").status, 200);
  release.set_value();
  EXPECT_EQ(scraper.ReadAnswer().body, "dhpmap_up 2\n");
  EXPECT_EQ(scraper.Ask("GET", "/healthz").status, 200) << "the connection lives on";
}

TEST_F(GatewayTest, MetricsAnswerHeadAndIgnoreABody) {
  const http::HttpAnswer head = client->Ask("HEAD", "/metrics");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.Header("Content-Length"), "12");
  EXPECT_EQ(client->Ask("GET", "/metrics", "{}").body, "dhpmap_up 1\n");
  EXPECT_EQ(client->Ask("POST", "/metrics", "{}").status, 405);
  EXPECT_EQ(client->Ask("GET", "/healthz").body, "ok\n") << "nothing was left on the connection";
}

TEST(PageExchange, APageForADisconnectedClientIsNotMade) {
  const auto responder = std::make_shared<RecordingResponder>();
  int num_made = 0;
  {
    Lane lane{{}};
    testing::LanePlug plug(lane);
    const auto exchange = MakePageExchange(
        [&num_made] {
          ++num_made;
          return http::Response();
        },
        lane, responder);
    EXPECT_TRUE(exchange->OnBody("x"));
    exchange->OnBodyEnd();
    exchange->OnClosed();
    plug.Release();
  }
  EXPECT_EQ(num_made, 0);
  EXPECT_TRUE(responder->replies.empty());
}

TEST(PageExchange, AFinishedPageForADisconnectedClientIsDropped) {
  const auto responder = std::make_shared<RecordingResponder>();
  std::shared_ptr<http::Exchange> exchange;
  {
    Lane lane{{}};
    exchange = MakePageExchange([] { return http::Response(); }, lane, responder);
  }  // its end waits for the page
  exchange->OnClosed();
  const std::weak_ptr<http::Exchange> left = std::exchange(exchange, nullptr);
  EXPECT_TRUE(responder->RunUntil([&] { return left.expired(); }));
  EXPECT_TRUE(responder->replies.empty());
}

TEST(PageExchange, TheGatewaysPagesUseNoLaneOfCalls) {
  CannedServer server;
  RpcCaller caller(server.channel());
  Lane bulk{{}}, frames{{}}, pages{{}};
  testing::LanePlug plug_bulk(bulk), plug_frames(frames);
  GatewayHooks hooks;
  hooks.metrics_text = [] { return std::string("dhpmap_up 3\n"); };
  const Dispatcher dispatcher(HttpRuleRouter::FromLinkedServices().value(),
                              {.caller = &caller, .bulk = &bulk, .shared = nullptr, .frames = &frames, .pages = &pages},
                              hooks, 1u << 20, std::make_shared<ByteBudget>(1u << 20));
  const auto feeding = std::make_shared<RecordingResponder>();
  const auto feed = dispatcher.Begin(RequestHeadOf("POST", "/v1/maps/a:integrateFrames"), feeding);
  EXPECT_NE(feed, nullptr);
  if (feed != nullptr) {
    EXPECT_FALSE(feed->OnBody("{" + std::string(2 * kMostQuickBytes, ' ') + "}")) << "it waits for its lane";
  }
  EXPECT_TRUE(caller.WaitUntilIdle(std::chrono::milliseconds(0)));
  for (const char* path : {"/healthz", "/readyz", "/metrics"}) {
    const auto responder = std::make_shared<RecordingResponder>();
    const auto exchange = dispatcher.Begin(RequestHeadOf("GET", path), responder);
    EXPECT_TRUE(responder->RunUntil([&] { return !responder->replies.empty(); })) << path;
    EXPECT_EQ(exchange != nullptr, std::string(path) == "/metrics");
    if (!responder->replies.empty()) {
      EXPECT_EQ(responder->replies[0].status, 200) << path;
    }
  }
  if (feed != nullptr) feed->OnClosed();
  plug_bulk.Release();
  plug_frames.Release();
}

}  // namespace
}  // namespace dhpmap::gateway

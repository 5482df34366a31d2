// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/pages.h"

#include "server/gateway/http_rule_router.h"
#include "tests/unit/server/gateway/gateway_fixture.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

TEST_F(GatewayTest, HealthReadinessAndMetrics) {
  EXPECT_EQ(client->Ask("GET", "/healthz").body, "ok\n");
  EXPECT_EQ(client->Ask("GET", "/readyz").status, 200);
  is_ready = false;
  EXPECT_EQ(client->Ask("GET", "/readyz").status, 503);
  EXPECT_EQ(client->Ask("GET", "/healthz").status, 200) << "alive, but not ready";
  const http::HttpAnswer metrics = client->Ask("GET", "/metrics?x=1");
  EXPECT_EQ(metrics.body, "dhpmap_up 1\n");
  EXPECT_EQ(metrics.Header("Content-Type"), "text/plain; version=0.0.4; charset=utf-8");
  const http::HttpAnswer wrong = client->Ask("POST", "/healthz", "{}");
  EXPECT_EQ(wrong.status, 405);
  EXPECT_EQ(wrong.Header("Allow"), "GET, HEAD");
}

TEST_F(GatewayTest, TheIndexNamesEveryRpc) {
  const auto index = AsJson(client->Ask("GET", "/").body);
  const auto router = HttpRuleRouter::FromLinkedServices();
  EXPECT_EQ(static_cast<std::size_t>(At(index, "methods").list_value().values_size()), router->routes().size());
}

TEST_F(GatewayTest, HeadAnswersLikeGetWithoutABody) {
  const http::HttpAnswer get = client->Ask("GET", "/openapi.json");
  const http::HttpAnswer head = client->Ask("HEAD", "/openapi.json");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.Header("Content-Length"), std::to_string(get.body.size()));
  EXPECT_EQ(client->Ask("GET", "/healthz").body, "ok\n") << "nothing was left on the connection";
}

TEST(Pages, WithoutHooksTheServerIsReadyAndHasNoMetrics) {
  const Pages pages(TestRouter(), {});
  EXPECT_EQ(pages.Make("/readyz").status, 200);
  EXPECT_EQ(pages.Make("/metrics").body, "");
}

TEST(Pages, AreMadeForEachRequestAndNotCached) {
  int num_asked = 0;
  const Pages pages(TestRouter(), {.is_ready = [&] { return ++num_asked > 1; },
                                   .metrics_text = [&] { return std::to_string(num_asked); }});
  EXPECT_EQ(num_asked, 0);
  EXPECT_EQ(pages.Make("/readyz").status, 503);
  EXPECT_EQ(pages.Make("/readyz").status, 200);
  EXPECT_EQ(pages.Make("/metrics").body, "2");
  EXPECT_EQ(http::FindHeader(pages.Make("/readyz").headers, "cache-control"), "no-store");
}

TEST(Pages, MatchExactPathsOnly) {
  const Pages pages(TestRouter(), {});
  for (const char* path : {"/", "/healthz", "/readyz", "/metrics", "/openapi.json"})
    EXPECT_TRUE(pages.Has(path)) << path;
  for (const char* path : {"", "/healthz/", "/Healthz", "/v1/maps", "//"}) EXPECT_FALSE(pages.Has(path)) << path;
}

}  // namespace
}  // namespace dhpmap::gateway

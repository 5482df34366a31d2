// SPDX-License-Identifier: BSD-3-Clause
// The header If-Match sets the etag of the RPC's request.
#include <gtest/gtest.h>

#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "tests/unit/server/gateway/gateway_fixture.h"

namespace dhpmap::gateway {
namespace {

TEST_F(GatewayTest, IfMatchIsTheEtagOfTheRequestOrOfItsBody) {
  EXPECT_EQ(client->Ask("DELETE", "/v1/maps/a/submaps/7", "", {{"If-Match", "\"r3\""}}).status, 200);
  EXPECT_EQ(Heard<v1::DeleteSubmapRequest>(1).etag(), "r3");
  EXPECT_EQ(client->Ask("PATCH", "/v1/maps/a/submaps/7", R"({"displayName":"x"})", {{"If-Match", "\"r4\""}}).status,
            200);
  const auto update = Heard<v1::UpdateSubmapRequest>(2);
  EXPECT_EQ(update.submap().etag(), "r4");
  ASSERT_EQ(update.update_mask().paths_size(), 1) << "a precondition is no change";
  EXPECT_EQ(client->Ask("DELETE", "/v1/maps/a", "", {{"If-Match", "*"}}).status, 200);
  EXPECT_EQ(Heard<v1::DeleteMapRequest>(3).etag(), "");
}

TEST_F(GatewayTest, AnUnsupportedIfMatchIsRefusedNotIgnored) {
  for (const char* bad : {"r3", "W/\"r3\"", "\"a\", \"b\"", "\""}) {
    EXPECT_EQ(client->Ask("DELETE", "/v1/maps/a", "", {{"If-Match", bad}}).status, 400) << bad;
  }
  EXPECT_EQ(client->Ask("POST", "/v1/maps", "{}", {{"If-Match", "\"r3\""}}).status, 400) << "takes no etag";
  EXPECT_EQ(client->Ask("PATCH", "/v1/maps/a", R"({"displayName":"x","etag":"r5"})", {{"If-Match", "\"r3\""}}).status,
            400)
      << "two that differ";
}

// No state has an empty tag, so nothing may be changed for it.
TEST_F(GatewayTest, IfMatchOfAnEmptyTagIsRefusedNotIgnored) {
  EXPECT_EQ(client->Ask("DELETE", "/v1/maps/a", "", {{"If-Match", ""}}).status, 400);
  EXPECT_EQ(client->Ask("DELETE", "/v1/maps/a", "", {{"If-Match", "\"\""}}).status, 400);
  EXPECT_EQ(client->Ask("PATCH", "/v1/maps/a", R"({"displayName":"x"})", {{"If-Match", "\"\""}}).status, 400);
  EXPECT_EQ(server.num_calls(), 0u);
}

}  // namespace
}  // namespace dhpmap::gateway

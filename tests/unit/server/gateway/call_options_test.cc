// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/call_options.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace dhpmap::gateway {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

std::optional<nanoseconds> TimeoutOf(const http::Headers& headers) {
  const auto options = MakeCallOptions("/a.B/C", headers);
  EXPECT_TRUE(options.ok()) << options.status().message();
  return options.ok() ? options->timeout : std::nullopt;
}

std::string ReasonOf(const http::Headers& headers) {
  return std::string(MakeCallOptions("/a.B/C", headers).status().reason().name());
}

TEST(CallOptions, ReadsTimeoutsOfBothKinds) {
  EXPECT_FALSE(TimeoutOf({}));
  EXPECT_EQ(TimeoutOf({{"X-Timeout-S", "0.25"}}), milliseconds(250));
  EXPECT_EQ(TimeoutOf({{"grpc-timeout", "500m"}}), milliseconds(500));
  EXPECT_EQ(TimeoutOf({{"grpc-timeout", "2S"}}), milliseconds(2000));
  EXPECT_EQ(TimeoutOf({{"grpc-timeout", "1H"}}), std::chrono::hours(1));
  EXPECT_EQ(TimeoutOf({{"x-timeout-s", "1"}, {"grpc-timeout", "9S"}}), milliseconds(1000)) << "ours goes first";
  EXPECT_EQ(TimeoutOf({{"x-timeout-s", "1e30"}}), std::chrono::hours(24)) << "a day at most";
}

TEST(CallOptions, RefusesInvalidTimeouts) {
  for (const char* text : {"x", "-1", "1s", "nan", "1 "}) {
    EXPECT_EQ(ReasonOf({{"X-Timeout-S", text}}), "BAD_TIMEOUT") << text;
  }
  for (const char* text : {"5", "S", "5x", "-5S", "5 S"}) {
    EXPECT_EQ(ReasonOf({{"grpc-timeout", text}}), "BAD_TIMEOUT") << text;
  }
}

TEST(CallOptions, ForwardsOnlyAllowedHeaders) {
  const auto options =
      MakeCallOptions("/a.B/C", {{"Authorization", "Bearer x"}, {"User-Agent", "curl"}, {"Cookie", "c"}});
  ASSERT_TRUE(options.ok());
  EXPECT_EQ(options->rpc_path, "/a.B/C");
  std::set<std::string> keys;
  for (const auto& [key, value] : options->metadata) keys.insert(key);
  EXPECT_EQ(keys, (std::set<std::string>{"x-request-id", "authorization", "x-user-agent"}));
}

TEST(CallOptions, KeepsTheRequestIdOrMakesOne) {
  EXPECT_EQ(RequestIdOf(*MakeCallOptions("/a.B/C", {{"X-Request-Id", "mine"}})), "mine");
  const std::string first = RequestIdOf(*MakeCallOptions("/a.B/C", {}));
  EXPECT_FALSE(first.empty());
  EXPECT_NE(first, RequestIdOf(*MakeCallOptions("/a.B/C", {})));
}

TEST(CallOptions, RefusesValuesThatGrpcCannotCarry) {
  EXPECT_EQ(ReasonOf({{"Authorization", "\xC3\xA4"}}), "BAD_HEADER");
  EXPECT_EQ(ReasonOf({{"X-Request-Id", "a\tb"}}), "BAD_HEADER");
}

}  // namespace
}  // namespace dhpmap::gateway

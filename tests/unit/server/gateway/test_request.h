// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "server/gateway/http_rule_router.h"
#include "server/gateway/rpc_request.h"

namespace dhpmap::gateway {

/// The routes of our services and of json_test.proto.
inline const HttpRuleRouter& TestRouter() {
  static const auto router = HttpRuleRouter::FromLinkedServices();
  EXPECT_TRUE(router.ok()) << router.status().message();
  return *router;
}

inline RouteMatch Matched(const std::string& method, const std::string& path) {
  RouteMatch match = TestRouter().Find(method, path);
  EXPECT_NE(match.route, nullptr) << method << " " << path;
  return match;
}

inline http::RequestHead RequestHeadOf(std::string method, std::string target, http::Headers headers = {},
                                       std::optional<std::uint64_t> content_length = std::nullopt) {
  http::RequestHead head;
  head.method = std::move(method);
  head.target = std::move(target);
  head.headers = std::move(headers);
  head.content_length = content_length;
  return head;
}

}  // namespace dhpmap::gateway

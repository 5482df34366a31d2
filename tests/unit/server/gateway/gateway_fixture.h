// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>

#include "server/gateway/gateway.h"
#include "tests/unit/server/gateway/canned_server.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::gateway {

/// A gateway on a free port, in front of a server with canned answers, and one connection to it.
class GatewayTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kMaxBody_bytes = 1u << 20;

  GatewayTest() {
    GatewayOptions options;
    options.address = "127.0.0.1:0";
    options.max_body_bytes = kMaxBody_bytes;
    GatewayHooks hooks;
    hooks.is_ready = [this] { return is_ready.load(); };
    hooks.metrics_text = [] { return "dhpmap_up 1\n"; };
    auto started = Gateway::Start(options, server.channel(), hooks);
    EXPECT_TRUE(started.ok()) << started.status().message();
    gateway = std::move(*started);
    client = std::make_unique<http::HttpClient>(gateway->port());
  }

  template <typename Request>
  Request Heard(std::size_t number = 1) {
    const HeardCall call = server.WaitForCall(number);
    Request request;
    EXPECT_TRUE(!call.requests.empty() && request.ParseFromString(call.requests.front()));
    return request;
  }

  std::atomic<bool> is_ready{true};
  CannedServer server;
  std::unique_ptr<Gateway> gateway;
  std::unique_ptr<http::HttpClient> client;
};

/// Megabytes that cross gRPC cost ThreadSanitizer a suppressed report every eight bytes.
#if defined(DHPMAP_THREAD_SANITIZER)
#define DHPMAP_SKIP_MEGABYTES() GTEST_SKIP() << "too slow under ThreadSanitizer"
#else
#define DHPMAP_SKIP_MEGABYTES() (void)0
#endif

inline google::protobuf::Struct AsJson(const std::string& text) {
  google::protobuf::Struct value;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text, &value).ok()) << text;
  return value;
}

inline const google::protobuf::Value& At(const google::protobuf::Struct& value, const std::string& key) {
  static const google::protobuf::Value none;
  const auto found = value.fields().find(key);
  if (found != value.fields().end()) return found->second;
  ADD_FAILURE() << "no " << key << " in " << value.ShortDebugString();
  return none;
}

}  // namespace dhpmap::gateway

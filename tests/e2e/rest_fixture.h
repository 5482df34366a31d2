// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/e2e/server_process.h"
#include "tests/integration/test_server.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::testing {

inline std::string JsonOf(const google::protobuf::Message& message) {
  std::string json;
  EXPECT_TRUE(google::protobuf::util::MessageToJsonString(message, &json).ok());
  return json;
}

/// A server process, asked over REST, and over gRPC for what is not about REST.
class RestTest : public ::testing::Test {
 protected:
  /// Variables of the environment, as "DHPMAP_MAPPING_MAX_FEEDS".
  using Settings = std::vector<std::pair<std::string, std::string>>;

  void Start(const Settings& settings = {}) {
    for (const auto& [name, value] : settings) setenv(name.c_str(), value.c_str(), 1);
    server_.emplace(root(), db());
    for (const auto& setting : settings) unsetenv(setting.first.c_str());
    ASSERT_TRUE(server_->is_serving()) << server_->process().Stderr();
    mapping_ = v1::MappingService::NewStub(server_->Connect());
  }
  void Create(const std::string& map_id) {
    const http::HttpAnswer made = Ask("POST", "/v1/maps", JsonOf(CreateRequest(map_id)));
    ASSERT_EQ(made.status, 200) << made.body;
  }
  /// Over a connection of its own.
  http::HttpAnswer Ask(std::string_view method, std::string_view target, std::string_view body = {},
                       http::HttpClient::Headers headers = {}) const {
    return http::HttpClient(http_port()).Ask(method, target, body, std::move(headers));
  }
  /// What GET answers, of "maps/room/submaps/1" say.
  template <typename Response>
  Response Get(const std::string& name) const {
    Response response;
    const http::HttpAnswer answer = Ask("GET", "/v1/" + name);
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(answer.body, &response).ok()) << answer.body;
    return response;
  }
  /// One frame as one JSON value.
  http::HttpAnswer PostFrame(const std::string& map_id, const std::string& session, int frame) const {
    v1::IntegrateFramesRequest request;
    request.set_session(session);
    request.set_sequence(frame);
    *request.mutable_frame() = TestFrame(frame);
    return Ask("POST", "/v1/maps/" + map_id + ":integrateFrames", JsonOf(request),
               {{"Content-Type", "application/json"}});
  }
  [[nodiscard]] int http_port() const {
    return std::stoi(server_->http_url().substr(server_->http_url().rfind(':') + 1));
  }
  [[nodiscard]] std::filesystem::path root() const { return temp_.path(); }
  [[nodiscard]] std::filesystem::path db() const { return root() / "maps.db"; }

  TempDir temp_;
  std::optional<ServerProcess> server_;
  std::unique_ptr<v1::MappingService::Stub> mapping_;
};

}  // namespace dhpmap::testing

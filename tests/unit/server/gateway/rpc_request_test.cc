// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/rpc_request.h"

#include "dhpmap/v1/watch_service.pb.h"
#include "tests/unit/server/gateway/test_request.h"

namespace dhpmap::gateway {
namespace {

constexpr std::size_t kMaxBody_bytes = 1000;

Result<RpcRequest> Made(const http::RequestHead& head) {
  return RpcRequest::Make(head, Matched(head.method, head.target), "", kMaxBody_bytes);
}

TEST(RpcRequest, ParsesEverythingExceptTheBody) {
  const auto request = Made(RequestHeadOf(
      "POST", "/v1/maps", {{"Content-Type", "application/x-protobuf"}, {"Accept", "application/json"}}, 12));
  ASSERT_TRUE(request.ok()) << request.status().message();
  EXPECT_EQ(request->call.rpc_path, "/dhpmap.v1.MapService/CreateMap");
  EXPECT_EQ(request->body_format, BodyFormat::kProtobuf);
  EXPECT_EQ(request->answer_format, AnswerFormat::kJson);
  EXPECT_EQ(request->announced_bytes, 12u);
  EXPECT_FALSE(request->is_head);
  EXPECT_TRUE(Made(RequestHeadOf("HEAD", "/v1/maps"))->is_head);
}

TEST(RpcRequest, TheLastEventIdPrecedesTheUrl) {
  const auto position_of = [](const char* query, http::Headers headers) {
    const http::RequestHead head = RequestHeadOf("GET", "/v1/maps/a:watch", std::move(headers));
    const auto request = RpcRequest::Make(head, Matched("GET", "/v1/maps/a:watch"), query, kMaxBody_bytes);
    v1::WatchMapRequest message;
    EXPECT_TRUE(request.ok() && message.ParseFromString(*request->transcoder.ToRequest(BodyFormat::kJson, "")));
    return message.resume_after();
  };
  EXPECT_EQ(position_of("resume_after=x-1", {}), "x-1");
  EXPECT_EQ(position_of("start_revision=3", {{"Last-Event-ID", "x-7"}}), "x-7");
  EXPECT_EQ(position_of("resume_after=x-1", {{"last-event-id", "x-7"}}), "x-7");
  const auto other = Made(RequestHeadOf("GET", "/v1/maps", {{"Last-Event-ID", "x-7"}}));
  EXPECT_TRUE(other.ok()) << "what tells no events has no use for it";
}

TEST(RpcRequest, RefusesABodyBeforeItArrives) {
  const auto at_limit = Made(RequestHeadOf("POST", "/v1/maps", {}, kMaxBody_bytes));
  EXPECT_TRUE(at_limit.ok()) << at_limit.status().message();
  const auto beyond = Made(RequestHeadOf("POST", "/v1/maps", {}, kMaxBody_bytes + 1));
  EXPECT_EQ(beyond.status().reason(), Reason("BODY_TOO_LARGE"));
  EXPECT_TRUE(Made(RequestHeadOf("POST", "/v1/maps/a:integrateFrames", {}, 1u << 30)).ok())
      << "a stream may be long: its messages are limited";
}

TEST(RpcRequest, WithoutListsIsNoLargerThanAMebibyte) {
  const auto made = [](const char* path, std::size_t num_bytes) {
    return RpcRequest::Make(RequestHeadOf("POST", path, {}, num_bytes), Matched("POST", path), "", 64u << 20);
  };
  EXPECT_EQ(made("/v1/maps/a:verify", (1u << 20) + 1).status().reason(), Reason("BODY_TOO_LARGE"));
  EXPECT_EQ(made("/v1/maps/a:verify", 1u << 20)->max_body_bytes, 1u << 20);
  EXPECT_EQ(made("/v1/maps/a:queryPoints", 2u << 20)->max_body_bytes, 64u << 20);
}

TEST(RpcRequest, RefusesTypesAndCodingsThatItCannotRead) {
  const std::pair<const char*, http::Headers> cases[] = {
      {"/v1/maps", {{"Content-Type", "text/xml"}}},
      {"/v1/maps", {{"Content-Encoding", "gzip"}}},
      {"/v1/maps", {{"Content-Type", "application/x-protobuf-stream"}}},
      {"/v1/maps/a:integrateFrames", {{"Content-Type", "multipart/form-data; boundary=x"}}},
  };
  for (const auto& [path, headers] : cases) {
    EXPECT_EQ(Made(RequestHeadOf("POST", path, headers, 1)).status().reason(), Reason("UNSUPPORTED_MEDIA_TYPE"))
        << headers[0].second;
  }
  EXPECT_TRUE(Made(RequestHeadOf("POST", "/v1/maps", {{"Content-Encoding", "Identity"}}, 1)).ok());
  EXPECT_TRUE(Made(RequestHeadOf("POST", "/v1/maps", {{"Content-Type", "text/xml"}}, 0)).ok()) << "there is no body";
  EXPECT_FALSE(
      Made(RequestHeadOf("POST", "/v1/maps", {{"Content-Type", "text/xml"}, {"Transfer-Encoding", "chunked"}})).ok());
}

TEST(RpcRequest, RefusesClientsThatAcceptNoAvailableType) {
  const http::Headers gltf = {{"Accept", "model/gltf-binary"}};
  EXPECT_EQ(Made(RequestHeadOf("GET", "/v1/maps/home", gltf)).status().reason(), Reason("NOT_ACCEPTABLE"));
  EXPECT_TRUE(Made(RequestHeadOf("GET", "/v1/maps/home/submaps/7/mesh", gltf)).ok()) << "it may be that file";
  EXPECT_TRUE(Made(RequestHeadOf("GET", "/v1/maps/home", {{"Accept", "model/*, */*;q=0.1"}})).ok());
}

TEST(RpcRequest, AFileIsNamedAfterThePathWithHarmlessCharactersOnly) {
  EXPECT_EQ(Made(RequestHeadOf("GET", "/v1/maps/home/submaps/7/mesh"))->file_stem, "maps_home_submaps_7");
  EXPECT_EQ(Made(RequestHeadOf("GET", "/test/files/a%22%0D%0A..%5Cb"))->file_stem, "a___.._b");
  EXPECT_EQ(Made(RequestHeadOf("GET", "/test/files/" + std::string(500, 'x')))->file_stem.size(), 128u);
  EXPECT_EQ(Made(RequestHeadOf("GET", "/v1/maps"))->file_stem, "download") << "no variable in the path";
}

TEST(RpcRequest, ErrorsOfHeadersAndQueryArePassedOn) {
  EXPECT_FALSE(Made(RequestHeadOf("GET", "/v1/maps", {{"X-Timeout-S", "soon"}})).ok());
  EXPECT_EQ(RpcRequest::Make(RequestHeadOf("GET", "/v1/maps"), Matched("GET", "/v1/maps"), "a=%2", kMaxBody_bytes)
                .status()
                .reason(),
            Reason("BAD_QUERY"));
}

}  // namespace
}  // namespace dhpmap::gateway

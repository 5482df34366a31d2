// SPDX-License-Identifier: BSD-3-Clause
// Streams that HTTP serves as files.
#include "json_test.pb.h"
#include "tests/unit/server/gateway/gateway_fixture.h"
#include "tests/unit/server/gateway/mesh_part.h"

namespace dhpmap::gateway {
namespace {

using json::test::Everything;

TEST_F(GatewayTest, AFileOfAnUnacceptedTypeIsNotSent) {
  server.Set("GetSubmapMesh", {.messages = {MeshPart("ply\n", "application/x-ply", 10), MeshPart("abcdef")}});
  const auto ask = [this](const char* accept) {
    return client->Ask("GET", "/v1/maps/home/submaps/7/mesh", "", {{"Accept", accept}});
  };
  for (const char* accept : {"model/gltf-binary", "application/x-pcd", "application/x-ply;q=0"}) {
    const http::HttpAnswer answer = ask(accept);
    EXPECT_EQ(answer.status, 406) << accept;
    EXPECT_EQ(answer.Header("Content-Type"), "application/json");
    EXPECT_NE(answer.body.find("NOT_ACCEPTABLE"), std::string::npos) << answer.body;
    EXPECT_NE(answer.body.find("application/x-ply"), std::string::npos) << "says what there is";
  }
  for (const char* accept : {"application/x-ply", "application/octet-stream", "model/gltf-binary, */*;q=0.1"}) {
    EXPECT_EQ(ask(accept).body, "ply\nabcdef") << accept;
  }
}

TEST_F(GatewayTest, AFileOfUnknownSizeIsChunked) {
  json::test::Part first, second;
  first.set_data("ab");
  first.set_content_type("text/x-weird type");
  second.set_data("c");
  server.Set("Download", {.messages = {first.SerializeAsString(), second.SerializeAsString()}});
  const http::HttpAnswer file = client->Ask("GET", "/test/files/a/b%20%22c");
  EXPECT_TRUE(file.was_chunked);
  EXPECT_EQ(file.body, "abc");
  EXPECT_EQ(file.Header("Content-Disposition"), "attachment; filename=\"a_b__c.bin\"");
  EXPECT_EQ(Heard<Everything>().text(), "a/b \"c");
}

TEST_F(GatewayTest, AFileShorterThanAnnouncedIsVisiblyTruncated) {
  for (const int announced : {3, 30}) {
    server.Set("GetSubmapMesh", {.messages = {MeshPart("ab", "x/y", announced), MeshPart("cdef")}});
    const http::HttpAnswer file = http::HttpClient(gateway->port()).Ask("GET", "/v1/maps/home/mesh");
    EXPECT_FALSE(file.is_complete) << announced;
    EXPECT_LT(file.body.size(), static_cast<std::size_t>(announced));
  }
}

}  // namespace
}  // namespace dhpmap::gateway

// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/content_encoding.h"

#include "tests/unit/server/gateway/gateway_fixture.h"
#include "tests/unit/server/gateway/mesh_part.h"

namespace dhpmap::gateway {
namespace {

TEST(ContentEncoding, GzipIsUsedIfTheClientAcceptsIt) {
  for (const char* header : {"gzip", "deflate, GZIP", "br;q=1, gzip;q=0.5", "gzip;q=0.001", "*", "*;q=0, gzip"})
    EXPECT_TRUE(TakesGzip(header)) << header;
  for (const char* header : {"", "identity", "gzip;q=0", "gzip;q=0.00", "br, gzip; q=0", "gzip;q=0, *", "gzipped"})
    EXPECT_FALSE(TakesGzip(header)) << header;
}

TEST(ContentEncoding, StrongAndWeakEtagsMatchInLists) {
  for (const char* header : {"\"g1\"", "\"x\", \"g1\"", "W/\"g1\"", "*"})
    EXPECT_TRUE(IsEtagNamed(header, "g1")) << header;
  for (const char* header : {"", "g1", "\"g12\"", "\"G1\""}) EXPECT_FALSE(IsEtagNamed(header, "g1")) << header;
  EXPECT_FALSE(IsEtagNamed("*", "")) << "what has none";
}

TEST(ContentEncoding, DataCompressedInPartsIsRestored) {
  std::string file, gzipped;
  GzipStream gzip;
  for (int i = 0; i < 5000; ++i) {
    const std::string part = "vertex " + std::to_string(i * i) + "\n";
    file += part;
    gzipped += gzip.Add(part);
  }
  gzipped += gzip.End();
  EXPECT_LT(gzipped.size(), file.size() / 2);
  EXPECT_EQ(Gunzip(gzipped, file.size()), file);
}

/// A mesh file of two messages with an etag.
class MeshOverHttp : public GatewayTest {
 protected:
  MeshOverHttp() {
    v1::GetSubmapMeshResponse first;
    first.set_data("glTF" + std::string(1000, 'a'));
    first.set_content_type("model/gltf-binary");
    first.set_total_bytes(2004);
    first.set_etag("g1");
    server.Set("GetSubmapMesh", {.messages = {first.SerializeAsString(), MeshPart(std::string(1000, 'b'))}});
  }
  const std::string file = "glTF" + std::string(1000, 'a') + std::string(1000, 'b');
};

TEST_F(MeshOverHttp, IsCompressedIfTheClientAcceptsIt) {
  const http::HttpAnswer plain = client->Ask("GET", "/v1/maps/home/mesh");
  EXPECT_EQ(plain.body, file);
  EXPECT_EQ(plain.Header("ETag"), "\"g1\"");
  EXPECT_EQ(plain.Header("Content-Encoding"), "");
  EXPECT_EQ(plain.Header("Content-Length"), "2004");
  EXPECT_EQ(plain.Header("Vary"), "Accept-Encoding");
  const http::HttpAnswer gzipped = client->Ask("GET", "/v1/maps/home/mesh", "", {{"Accept-Encoding", "gzip, br"}});
  EXPECT_EQ(gzipped.Header("Content-Encoding"), "gzip");
  EXPECT_EQ(gzipped.Header("Vary"), "Accept-Encoding");
  EXPECT_EQ(gzipped.Header("ETag"), "\"g1-gzip\"") << "other bytes";
  EXPECT_TRUE(gzipped.is_complete);
  EXPECT_LT(gzipped.body.size(), 200u);
  EXPECT_EQ(Gunzip(gzipped.body, file.size()), file);
}

TEST_F(MeshOverHttp, IsNotSentAgainToAClientThatHasIt) {
  const http::HttpAnswer same = client->Ask("GET", "/v1/maps/home/mesh", "", {{"If-None-Match", "\"g1\""}});
  EXPECT_EQ(same.status, 304);
  EXPECT_EQ(same.Header("ETag"), "\"g1\"");
  EXPECT_EQ(same.body, "");
  const auto ask_gzip = [this](const char* etag) {
    return client->Ask("GET", "/v1/maps/home/mesh", "", {{"Accept-Encoding", "gzip"}, {"If-None-Match", etag}});
  };
  EXPECT_EQ(ask_gzip("\"g1-gzip\"").status, 304);
  EXPECT_EQ(ask_gzip("\"g1\"").status, 200) << "those are other bytes";
  const http::HttpAnswer other = client->Ask("GET", "/v1/maps/home/mesh", "", {{"If-None-Match", "\"g0\""}});
  EXPECT_EQ(other.status, 200);
  EXPECT_EQ(other.body, file) << "nothing of the one before was left on the connection";
}

TEST_F(MeshOverHttp, ThatEndsEarlyIsVisiblyTruncatedEvenIfCompressed) {
  v1::GetSubmapMeshResponse first;
  first.set_data("glTF");
  first.set_content_type("model/gltf-binary");
  first.set_total_bytes(2004);
  server.Set("GetSubmapMesh", {.messages = {first.SerializeAsString()}});
  EXPECT_FALSE(client->Ask("GET", "/v1/maps/home/mesh", "", {{"Accept-Encoding", "gzip"}}).is_complete);
}

TEST(ContentEncoding, MapsEtagsOfAVariantToTheOriginal) {
  EXPECT_EQ(EtagsNamed(R"("a1", W/"b2-gzip", "c3")", false), "a1,c3");
  EXPECT_EQ(EtagsNamed(R"("a1", W/"b2-gzip", "c3")", true), "b2");
  EXPECT_EQ(EtagsNamed(R"(*, "", "-gzip", "x y", a1, "d4)", false), "");
  EXPECT_EQ(EtagsNamed(R"("", "-gzip", "a,b")", true), "");
  EXPECT_EQ(EtagsNamed("", true), "");
  std::string many = "\"first\"";
  for (int i = 0; i < 5000; ++i) many += ", \"g" + std::to_string(i) + '"';
  const std::string named = EtagsNamed(many, false);
  EXPECT_LE(named.size(), 1024u);
  EXPECT_TRUE(named.starts_with("first,g0,g1,"));
}

}  // namespace
}  // namespace dhpmap::gateway

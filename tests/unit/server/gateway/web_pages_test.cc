// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/web_pages.h"

#include "server/gateway/content_encoding.h"
#include "server/web/web_files.h"
#include "tests/unit/server/gateway/gateway_fixture.h"

namespace dhpmap::gateway {
namespace {

TEST_F(GatewayTest, TheViewerIsServedWithAndWithoutGzip) {
  ASSERT_FALSE(web::WebFiles().empty());
  for (const web::WebFile& file : web::WebFiles()) {
    const std::string path = "/ui/" + std::string(file.name);
    const http::HttpAnswer plain = client->Ask("GET", path);
    const http::HttpAnswer gzipped = client->Ask("GET", path, "", {{"Accept-Encoding", "gzip"}});
    EXPECT_EQ(plain.status, 200) << path;
    EXPECT_EQ(plain.Header("Content-Type"), file.type);
    EXPECT_EQ(plain.body.size(), file.size);
    EXPECT_EQ(gzipped.Header("Content-Encoding"), "gzip");
    EXPECT_EQ(Gunzip(gzipped.body, file.size), plain.body);
  }
  EXPECT_EQ(client->Ask("GET", "/ui/").body, client->Ask("GET", "/ui/index.html").body);
  EXPECT_EQ(client->Ask("GET", "/ui/other.js").status, 404);
  EXPECT_EQ(client->Ask("POST", "/ui/", "{}").status, 405);
}

TEST_F(GatewayTest, TheViewerMayConnectOnlyToThisServer) {
  const http::HttpAnswer page = client->Ask("GET", "/ui/");
  const std::string policy = page.Header("Content-Security-Policy");
  EXPECT_NE(policy.find("default-src 'none'; script-src 'self'; style-src 'self'"), std::string::npos) << policy;
  for (const char* hole : {"unsafe", "http:", "https:", "*"}) EXPECT_EQ(policy.find(hole), std::string::npos) << hole;
  EXPECT_EQ(page.Header("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(page.body.find("://"), std::string::npos) << "names no other host";
  EXPECT_EQ(page.body.find("<script>"), std::string::npos) << "no script in the page";
}

TEST_F(GatewayTest, TheViewerIsNotSentAgainIfCached) {
  const std::string etag = client->Ask("GET", "/ui/viewer.js").Header("ETag");
  const http::HttpAnswer again = client->Ask("GET", "/ui/viewer.js", "", {{"If-None-Match", etag}});
  EXPECT_EQ(again.status, 304);
  EXPECT_EQ(again.body, "");
}

TEST_F(GatewayTest, TheRootRedirectsBrowsersToTheViewerAndServesOthersTheIndex) {
  const http::HttpAnswer browser =
      client->Ask("GET", "/", "", {{"Accept", "text/html,application/xhtml+xml,*/*;q=0.8"}});
  EXPECT_EQ(browser.status, 302);
  EXPECT_EQ(browser.Header("Location"), "/ui/");
  EXPECT_EQ(client->Ask("GET", "/ui").status, 302);
  EXPECT_EQ(client->Ask("GET", "/", "", {{"Accept", "*/*"}}).status, 200);
}

}  // namespace
}  // namespace dhpmap::gateway

// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/host_names.h"

#include <gtest/gtest.h>

namespace dhpmap::http {
namespace {

constexpr std::string_view kLocal = "192.168.1.5";

RequestHead HeadFor(Headers headers, std::string target = "/x") {
  RequestHead head;
  head.method = "POST";
  head.target = std::move(target);
  head.headers = std::move(headers);
  return head;
}

class HostNamesTest : public ::testing::Test {
 protected:
  std::string ReasonOf(const RequestHead& head, bool is_http_1_1 = true) const {
    return std::string(names.Check(head, is_http_1_1, kLocal).reason().name());
  }
  bool IsForeign(std::string host, std::string origin, std::string target = "/x") const {
    return names.IsFromForeignPage(HeadFor({{"Host", std::move(host)}, {"Origin", std::move(origin)}}, target), kLocal);
  }

  HostNames names{"0.0.0.0", {"maps.example.com"}};
};

TEST(SplitAuthority, KnowsNamesAddressesAndPorts) {
  EXPECT_EQ(SplitAuthority("localhost")->host, "localhost");
  EXPECT_EQ(SplitAuthority("localhost:8080")->port, "8080");
  EXPECT_EQ(SplitAuthority("[::1]:8080")->host, "::1");
  EXPECT_EQ(SplitAuthority("[::1]:8080")->port, "8080");
  EXPECT_EQ(SplitAuthority("a:")->port, "");
  for (const char* text : {"", ":80", "a b", "a@b", "a/b", "a:x", "a:123456", "[::1", "[::1]80", "a:1:2", "a,b"}) {
    EXPECT_FALSE(SplitAuthority(text)) << text;
  }
}

TEST_F(HostNamesTest, OnlyOurNamesAreAnswered) {
  for (const char* host : {"localhost", "LOCALHOST:9999", "127.0.0.1:8080", "[::1]:8080", "192.168.1.5",
                           "maps.example.com", "Maps.Example.Com:443"}) {
    EXPECT_EQ(ReasonOf(HeadFor({{"Host", host}})), "") << host;
  }
  for (const char* host :
       {"evil.example", "evil.example:8080", "192.168.1.6", "localhost.evil.example", "x.maps.example.com"}) {
    EXPECT_EQ(ReasonOf(HeadFor({{"Host", host}})), "HOST_NOT_ALLOWED") << host;
  }
}

TEST_F(HostNamesTest, ThereIsExactlyOneHost) {
  EXPECT_EQ(ReasonOf(HeadFor({})), "MALFORMED_HTTP");
  EXPECT_EQ(ReasonOf(HeadFor({{"Host", ""}})), "MALFORMED_HTTP");
  EXPECT_EQ(ReasonOf(HeadFor({{"Host", "localhost"}, {"host", "localhost"}})), "MALFORMED_HTTP");
  EXPECT_EQ(ReasonOf(HeadFor({{"Host", "localhost, evil"}})), "MALFORMED_HTTP");
  EXPECT_EQ(ReasonOf(HeadFor({}), /*is_http_1_1=*/false), "") << "HTTP/1.0 has none";
}

TEST_F(HostNamesTest, ATargetWithAHostIsCheckedToo) {
  EXPECT_EQ(ReasonOf(HeadFor({{"Host", "localhost"}}, "http://localhost:8080/x")), "");
  EXPECT_EQ(ReasonOf(HeadFor({{"Host", "localhost"}}, "http://evil.example/x")), "HOST_NOT_ALLOWED");
  EXPECT_EQ(ReasonOf(HeadFor({{"Host", "evil.example"}}, "http://localhost/x")), "HOST_NOT_ALLOWED");
}

TEST_F(HostNamesTest, PagesOfThisServerAndOfAllowedNamesAreNotForeign) {
  EXPECT_FALSE(names.IsFromForeignPage(HeadFor({{"Host", "localhost"}}), kLocal)) << "no page at all";
  EXPECT_FALSE(IsForeign("localhost:8080", "http://localhost:8080"));
  EXPECT_FALSE(IsForeign("localhost", "http://LOCALHOST:80"));
  EXPECT_FALSE(IsForeign("192.168.1.5:8080", "http://192.168.1.5:8080"));
  EXPECT_FALSE(IsForeign("localhost:8080", "https://maps.example.com")) << "through a proxy";
}

TEST_F(HostNamesTest, PagesOfOtherNamesAreForeign) {
  EXPECT_TRUE(IsForeign("localhost:8080", "http://evil.example"));
  EXPECT_TRUE(IsForeign("evil.example", "http://evil.example")) << "whatever the request says of itself";
  EXPECT_TRUE(IsForeign("localhost:8080", "http://localhost:3000")) << "another server on this machine";
  EXPECT_TRUE(IsForeign("localhost:8080", "null"));
  EXPECT_TRUE(IsForeign("localhost:8080", "http://localhost:8080, http://evil.example"));
  EXPECT_TRUE(names.IsFromForeignPage(
      HeadFor({{"Host", "localhost"}, {"Origin", "http://localhost"}, {"Origin", "http://evil.example"}}), kLocal));
}

}  // namespace
}  // namespace dhpmap::http

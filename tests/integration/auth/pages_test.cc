// SPDX-License-Identifier: BSD-3-Clause
// Attacks by web pages, of this server's origin and of others.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/integration/auth/locked_server.h"

namespace dhpmap::testing {
namespace {

TEST(AttacksOfPages, ALoginCookieCountsOnlyForTheServersOwnPages) {
  using Headers = http::HttpClient::Headers;
  LockedServer locked;
  EXPECT_EQ(locked.Ask("", "POST", "/ui/login").status, 401);
  EXPECT_EQ(locked.Ask(locked.key_of("admin"), "GET", "/ui/login").status, 405);
  EXPECT_EQ(locked.Ask(locked.key_of("admin"), "POST", "/ui/login", "", {{"Origin", "http://evil.example"}}).status,
            403);
  const http::HttpAnswer login = locked.Ask(locked.key_of("admin"), "POST", "/ui/login");
  ASSERT_EQ(login.status, 204);
  const std::string set = login.Header("Set-Cookie");
  for (const char* part : {"__Host-dhpmap=", "; Path=/", "; HttpOnly", "; Secure", "; SameSite=Strict"}) {
    EXPECT_NE(set.find(part), std::string::npos) << part;
  }
  const std::string cookie = set.substr(0, set.find(';'));
  const auto ask = [&](Headers headers, const char* method = "GET") {
    headers.emplace_back("Cookie", "theme=dark; " + cookie);
    return locked.Ask("", method, "/v1/maps/none", "", headers).status;
  };
  EXPECT_EQ(ask({{"Sec-Fetch-Site", "same-origin"}}), 404) << "as an admin";
  EXPECT_EQ(ask({{"Origin", "http://localhost"}}, "DELETE"), 404);
  EXPECT_EQ(ask({}), 403) << "no browser's page";
  EXPECT_EQ(ask({{"Sec-Fetch-Site", "cross-site"}}), 403);
  EXPECT_EQ(ask({{"Sec-Fetch-Site", "same-site"}}), 403) << "another port of this machine";
  EXPECT_EQ(ask({{"Sec-Fetch-Site", "same-site"}, {"Origin", "http://localhost"}}), 403) << "whatever its Origin";
  EXPECT_EQ(ask({{"Sec-Fetch-Site", "same-origin"}, {"Origin", "http://evil.example"}}), 403);
  EXPECT_EQ(ask({{"Sec-Fetch-Site", "same-origin"}, {"Authorization", "Bearer x"}}), 400);
  EXPECT_EQ(ask({{"Sec-Fetch-Site", "same-origin"}, {"Cookie", cookie}}), 400) << "twice";
  locked.Ask("", "POST", "/ui/logout", "", {{"Cookie", cookie}});
  EXPECT_EQ(ask({{"Sec-Fetch-Site", "same-origin"}}), 401);
}

TEST(AttacksOfPages, ALoginEndsWithItsKey) {
  LockedServer locked;
  const std::string anna = locked.MakeKey({.name = "anna"});
  const std::string set = locked.Ask(anna, "POST", "/ui/login").Header("Set-Cookie");
  const http::HttpClient::Headers headers = {{"Cookie", set.substr(0, set.find(';'))},
                                             {"Sec-Fetch-Site", "same-origin"}};
  EXPECT_EQ(locked.Ask("", "GET", "/v1/maps", "", headers).status, 200);
  locked.Revoke("anna");
  EXPECT_EQ(locked.Ask("", "GET", "/v1/maps", "", headers).status, 401);
}

TEST(AttacksOfPages, AnAllowedOriginUsesItsKeyAndNeverALogin) {
  constexpr char kFleet[] = "https://fleet.example";
  LockedServer locked({}, {kFleet});
  const std::string admin = locked.key_of("admin");
  const http::HttpClient::Headers asks = {{"Origin", kFleet}, {"Access-Control-Request-Method", "DELETE"}};
  const http::HttpAnswer preflight = locked.Ask("", "OPTIONS", "/v1/maps/a", "", asks);
  EXPECT_EQ(preflight.status, 204) << "which shows no key";
  EXPECT_EQ(preflight.Header("Access-Control-Allow-Origin"), kFleet);
  EXPECT_EQ(locked.Ask(admin, "DELETE", "/v1/maps/none", "", {{"Origin", kFleet}}).status, 404);
  const http::HttpAnswer keyless = locked.Ask("", "GET", "/v1/maps", "", {{"Origin", kFleet}});
  EXPECT_EQ(keyless.status, 401);
  EXPECT_EQ(keyless.Header("Access-Control-Allow-Origin"), kFleet) << "so that the page can tell why";
  EXPECT_EQ(locked.Ask(admin, "POST", "/ui/login", "", {{"Origin", kFleet}}).status, 403);
  const std::string set = locked.Ask(admin, "POST", "/ui/login").Header("Set-Cookie");
  const std::string cookie = set.substr(0, set.find(';'));
  for (const char* method : {"GET", "DELETE"}) {
    EXPECT_EQ(locked.Ask("", method, "/v1/maps/none", "", {{"Origin", kFleet}, {"Cookie", cookie}}).status, 403);
  }
  EXPECT_EQ(locked.Ask(admin, "DELETE", "/v1/maps/none", "", {{"Origin", "https://evil.example"}}).status, 403);
}

TEST(AttacksOfPages, EventStreamsNeedAKeyToo) {
  LockedServer locked;
  ASSERT_OK(locked.Call(locked.key_of("robot"), &MapStub::CreateMap, CreateRequest("a")));
  const http::HttpAnswer answer = locked.Ask("", "GET", "/v1/maps/a:watch", "", {{"Accept", "text/event-stream"}});
  EXPECT_EQ(answer.status, 401);
  EXPECT_NE(answer.body.find("NO_CREDENTIAL"), std::string::npos);
}

TEST(AttacksOfPages, APreflightOfAnotherOriginGetsNoPermission) {
  const http::HttpClient::Headers asks = {{"Origin", "https://evil.example"},
                                          {"Access-Control-Request-Method", "DELETE"}};
  LockedServer closed, open({}, {"https://fleet.example"});
  for (const LockedServer* locked : {&closed, &open}) {
    const http::HttpAnswer answer = locked->Ask("", "OPTIONS", "/v1/maps/a", "", asks);
    EXPECT_EQ(answer.status, 204);
    EXPECT_EQ(answer.Header("Access-Control-Allow-Origin"), "");
  }
}

}  // namespace
}  // namespace dhpmap::testing

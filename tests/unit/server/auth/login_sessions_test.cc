// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/login_sessions.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/server/auth/keys/known_bytes.h"

namespace dhpmap::auth {
namespace {

PrincipalPtr Somebody(const std::string& name = "anna") {
  return std::make_shared<const Principal>(Principal{.name = name});
}

TEST(LoginSessions, AWordIsValidUntilItExpiresOrEnds) {
  LoginSessions logins(KnownBytes());
  const PrincipalPtr anna = Somebody(), bert = Somebody();
  const std::string a = logins.Begin(anna, 100), b = logins.Begin(bert, 200);
  EXPECT_EQ(a.size(), 64u);
  EXPECT_EQ(logins.Find(a, 100), anna);
  EXPECT_EQ(logins.Find(b, 100 + LoginSessions::kLife_s), bert);
  EXPECT_EQ(logins.Find(a, 100 + LoginSessions::kLife_s), nullptr);
  EXPECT_EQ(logins.Find(a, 100), nullptr) << "for good";
  EXPECT_EQ(logins.Find("", 100), nullptr);
  logins.End(b);
  EXPECT_EQ(logins.Find(b, 200), nullptr);
}

TEST(LoginSessions, BeyondTheLimitTheOldestIsDropped) {
  LoginSessions logins(SystemRandomness());
  const std::string first = logins.Begin(Somebody("0"), 0), second = logins.Begin(Somebody("1"), 0);
  for (std::size_t i = 2; i < LoginSessions::kMost; ++i) (void)logins.Begin(Somebody(std::to_string(i)), 0);
  EXPECT_NE(logins.Find(first, 1), nullptr);
  (void)logins.Begin(Somebody("more"), 0);
  EXPECT_EQ(logins.Find(first, 1), nullptr);
  EXPECT_NE(logins.Find(second, 1), nullptr);
}

TEST(LoginSessions, ManyLoginsOfOneCallerLogNoOtherOut) {
  LoginSessions logins(SystemRandomness());
  const std::string bert = logins.Begin(Somebody("bert"), 0), first = logins.Begin(Somebody(), 0);
  std::string last;
  for (std::size_t i = 0; i < LoginSessions::kMostOfOne; ++i) last = logins.Begin(Somebody(), 0);
  EXPECT_EQ(logins.Find(first, 1), nullptr);
  EXPECT_NE(logins.Find(last, 1), nullptr);
  EXPECT_NE(logins.Find(bert, 1), nullptr);
}

}  // namespace
}  // namespace dhpmap::auth

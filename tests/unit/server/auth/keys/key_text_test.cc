// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_text.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "server/auth/keys/utc_text.h"
#include "tests/unit/server/auth/keys/known_bytes.h"

namespace dhpmap::auth {
namespace {

TEST(KeyText, IsFormattedAndReadBack) {
  const std::string text = MakeKeyText(KnownBytes());
  EXPECT_TRUE(std::regex_match(text, std::regex("dhp_[0-9a-f]{12}_[0-9a-f]{64}_[0-9a-f]{8}"))) << text;
  EXPECT_EQ(text.substr(0, 21), "dhp_010203040506_0708");
  const auto key = ParseKeyText(text);
  ASSERT_TRUE(key);
  EXPECT_EQ(key->id, "010203040506");
  EXPECT_EQ(key->secret, text.substr(0, 81));
}

TEST(KeyText, ATypoIsNoKey) {
  const std::string text = MakeKeyText(KnownBytes());
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string wrong = text;
    wrong[i] = wrong[i] == '7' ? '8' : '7';
    EXPECT_FALSE(ParseKeyText(wrong)) << "at " << i;
  }
  for (const std::string& wrong : {std::string(), text + "0", text.substr(1), std::string(kKeyTextBytes, '\0')}) {
    EXPECT_FALSE(ParseKeyText(wrong));
  }
}

TEST(KeyText, TheSystemsRandomnessRepeatsNothing) {
  std::set<std::string> made;
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(made.insert(MakeKeyText(SystemRandomness())).second);
}

TEST(KeyText, DigestsAreSha256) {
  // FIPS 180-2, appendix B.1.
  constexpr const char* kOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  EXPECT_EQ(HexOf(DigestOf("abc")), kOfAbc);
  EXPECT_EQ(DigestFromHex(kOfAbc), DigestOf("abc"));
  EXPECT_TRUE(AreSame(DigestOf("abc"), DigestOf("abc")));
  EXPECT_FALSE(AreSame(DigestOf("abc"), DigestOf("abd")));
  EXPECT_FALSE(DigestFromHex(std::string(kOfAbc).substr(2)));
  EXPECT_FALSE(DigestFromHex("BA" + std::string(kOfAbc).substr(2))) << "one way to write it";
}

TEST(UtcText, TimesAndDurationsAreReadBack) {
  EXPECT_EQ(UtcText(1'796'040'000), "2026-11-30T12:00:00Z");
  EXPECT_EQ(UtcFromText("2026-11-30T12:00:00Z"), 1'796'040'000);
  for (const char* wrong : {"", "2026-11-30", "2026-11-30T12:00:00", "2026-11-30T12:00:00Z ", "never"}) {
    EXPECT_FALSE(UtcFromText(wrong)) << wrong;
  }
  EXPECT_EQ(DurationFromText("90d"), 90 * 86'400);
  EXPECT_EQ(DurationFromText("24h"), 86'400);
  EXPECT_EQ(DurationFromText("0s"), 0);
  for (const char* wrong : {"", "d", "-1d", "1", "1w", "1d ", "99999999999999999999d", "36501d"}) {
    EXPECT_FALSE(DurationFromText(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace dhpmap::auth

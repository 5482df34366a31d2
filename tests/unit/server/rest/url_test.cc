// SPDX-License-Identifier: BSD-3-Clause
#include "server/rest/url.h"

#include <gtest/gtest.h>

#include "server/rest/base64.h"

namespace dhpmap::rest {
namespace {

TEST(SplitTarget, SeparatesPathAndQuery) {
  const auto target = SplitTarget("/v1/maps?a=1&b=2");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/v1/maps");
  EXPECT_EQ(target->query, "a=1&b=2");
}

TEST(SplitTarget, TakesTheAbsoluteFormAndDropsFragments) {
  EXPECT_EQ(SplitTarget("http://host:8080/v1/maps?x=1")->path, "/v1/maps");
  EXPECT_EQ(SplitTarget("http://host:8080/v1/maps?x=1")->query, "x=1");
  EXPECT_EQ(SplitTarget("http://host")->path, "/");
  EXPECT_EQ(SplitTarget("http://host?x")->query, "x");
  EXPECT_EQ(SplitTarget("/a#b")->path, "/a");
}

TEST(SplitTarget, RefusesWhatIsNoPath) {
  EXPECT_FALSE(SplitTarget("*"));
  EXPECT_FALSE(SplitTarget(""));
  EXPECT_FALSE(SplitTarget("host:80"));
}

TEST(PercentDecode, DecodesAllButSlashesWhereAsked) {
  EXPECT_EQ(PercentDecode("a%20b%2fc", false, false), "a b/c");
  EXPECT_EQ(PercentDecode("a%20b%2fc", false, true), "a b%2fc");
  EXPECT_EQ(PercentDecode("a+b", true, false), "a b");
  EXPECT_EQ(PercentDecode("a+b", false, false), "a+b");
}

TEST(PercentDecode, RefusesBrokenEscapes) {
  for (const char* text : {"%", "%2", "%zz", "a%g0", "%2%"}) EXPECT_FALSE(PercentDecode(text, false, false)) << text;
}

TEST(ParseQuery, KeepsOrderAndEmptyValues) {
  const auto pairs = ParseQuery("a=1&&b&c=x%26y&a=2");
  ASSERT_TRUE(pairs);
  const QueryPairs expected = {{"a", "1"}, {"b", ""}, {"c", "x&y"}, {"a", "2"}};
  EXPECT_EQ(*pairs, expected);
  EXPECT_FALSE(ParseQuery("a=%"));
}

TEST(FindInvalidUtf8, AcceptsEveryLengthAndRefusesTheForbidden) {
  EXPECT_EQ(FindInvalidUtf8("plain ascii, longer than eight"), std::string_view::npos);
  EXPECT_EQ(FindInvalidUtf8("\xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80"), std::string_view::npos);
  EXPECT_EQ(FindInvalidUtf8("abcdefgh\xFF"), 8u);
  EXPECT_EQ(FindInvalidUtf8("\xC0\x80"), 0u) << "overlong";
  EXPECT_EQ(FindInvalidUtf8("\xED\xA0\x80"), 0u) << "surrogate";
  EXPECT_EQ(FindInvalidUtf8("\xF4\x90\x80\x80"), 0u) << "beyond U+10FFFF";
  EXPECT_EQ(FindInvalidUtf8("a\xE2\x82"), 1u) << "cut off";
  EXPECT_EQ(ToValidUtf8("a\xE2\x82z\xFF"), "a??z?");
}

TEST(Base64, RoundTripsEveryLength) {
  std::string bytes;
  for (int i = 0; i < 70; ++i) {
    std::string text;
    AppendBase64(bytes, &text);
    EXPECT_EQ(text.size() % 4, 0u);
    EXPECT_EQ(DecodeBase64(text), bytes);
    while (!text.empty() && text.back() == '=') text.pop_back();
    EXPECT_EQ(DecodeBase64(text), bytes) << "without padding";
    bytes += static_cast<char>(i * 37 + 200);
  }
}

TEST(Base64, TakesBothAlphabetsAndRefusesTheRest) {
  EXPECT_EQ(DecodeBase64("-_-_"), DecodeBase64("+/+/"));
  for (const char* text : {"A", "AAAAA", "AA!A", "AA=A", "====", "A A="}) EXPECT_FALSE(DecodeBase64(text)) << text;
}

}  // namespace
}  // namespace dhpmap::rest

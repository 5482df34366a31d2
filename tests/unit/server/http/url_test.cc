// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/url.h"

#include <gtest/gtest.h>

namespace dhpmap::http {
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

TEST(SplitTarget, RefusesInvalidPaths) {
  EXPECT_FALSE(SplitTarget("*"));
  EXPECT_FALSE(SplitTarget(""));
  EXPECT_FALSE(SplitTarget("host:80"));
}

TEST(PercentDecode, DecodesAllExceptSlashesIfRequested) {
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

}  // namespace
}  // namespace dhpmap::http

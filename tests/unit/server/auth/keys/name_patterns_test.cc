// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/name_patterns.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>

namespace dhpmap::auth {
namespace {

NamePatterns Patterns(std::vector<std::string> texts) {
  auto patterns = NamePatterns::Make(std::move(texts));
  EXPECT_TRUE(patterns.ok()) << patterns.status().ToString();
  return patterns.ok() ? *patterns : NamePatterns();
}

TEST(NamePatterns, ExclusionsWinOverEveryMatch) {
  const NamePatterns sites = Patterns({"site-*", "!site-secret", "lab"});
  for (const char* in : {"site-", "site-a", "site-secret-not", "lab"}) EXPECT_TRUE(sites.Match(in)) << in;
  for (const char* out : {"", "site", "site-secret", "lab2", "Lab", "xsite-a"}) EXPECT_FALSE(sites.Match(out)) << out;
  EXPECT_FALSE(sites.match_all());
  EXPECT_FALSE(Patterns({"!site-secret", "*"}).Match("site-secret")) << "in any order";
  EXPECT_FALSE(Patterns({"!a"}).Match("b")) << "nothing is in that no pattern lets in";
}

TEST(NamePatterns, AllMatchesEverything) {
  EXPECT_TRUE(NamePatterns::All().match_all());
  EXPECT_TRUE(NamePatterns::All().Match(""));
  EXPECT_FALSE(Patterns({"*", "!x"}).match_all());
  EXPECT_FALSE(Patterns({"a*"}).match_all());
  EXPECT_FALSE(NamePatterns().Match("a"));
}

TEST(NamePatterns, MatchLikeAPlainRecursion) {
  const std::function<bool(std::string_view, std::string_view)> is_like = [&](std::string_view p, std::string_view n) {
    if (p.empty()) return n.empty();
    if (p[0] == '*') return is_like(p.substr(1), n) || (!n.empty() && is_like(p, n.substr(1)));
    return !n.empty() && p[0] == n[0] && is_like(p.substr(1), n.substr(1));
  };
  std::mt19937 random(7);
  const auto text = [&](const char* letters, int num_letters) {
    std::string made;
    for (auto left = random() % 7; left > 0; --left) made += letters[random() % static_cast<unsigned>(num_letters)];
    return made;
  };
  int num_matches = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::string pattern = text("ab*", 3), name = text("ab", 2);
    if (pattern.empty()) continue;
    const bool expected = is_like(pattern, name);
    num_matches += expected ? 1 : 0;
    EXPECT_EQ(Patterns({pattern}).Match(name), expected) << pattern << " on " << name;
  }
  EXPECT_GT(num_matches, 1'000);
}

TEST(NamePatterns, ManyStarsAreMatchedQuickly) {
  std::string stars;
  for (int i = 0; i < 100; ++i) stars += "a*";
  EXPECT_FALSE(Patterns({stars + "b"}).Match(std::string(60'000, 'a')));
}

TEST(NamePatterns, InvalidOnesAreRefused) {
  EXPECT_FALSE(NamePatterns::Make({}).ok());
  EXPECT_FALSE(NamePatterns::Make(std::vector<std::string>(NamePatterns::kMostPatterns + 1, "a")).ok());
  for (const char* wrong : {"", "!", "a b", "a/b", "a!", "\xc3\xa4", "maps/a"}) {
    EXPECT_EQ(NamePatterns::Make({wrong}).status().reason(), Reason("BAD_KEY")) << wrong;
  }
  EXPECT_FALSE(NamePatterns::Make({std::string(NamePatterns::kMostBytes + 1, 'a')}).ok());
}

}  // namespace
}  // namespace dhpmap::auth

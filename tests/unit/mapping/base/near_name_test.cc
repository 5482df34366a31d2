// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/near_name.h"

#include <gtest/gtest.h>

#include <vector>

namespace dhpmap {
namespace {

using Names = std::vector<std::string>;

TEST(SpellingDistance, CountsWhatMustBeMended) {
  EXPECT_EQ(SpellingDistance("", ""), 0);
  EXPECT_EQ(SpellingDistance("sofa", "Sofa"), 0);
  EXPECT_EQ(SpellingDistance("", "sofa"), 4);
  EXPECT_EQ(SpellingDistance("sofaa", "sofa"), 1);
  EXPECT_EQ(SpellingDistance("soa", "sofa"), 1);
  EXPECT_EQ(SpellingDistance("sosa", "sofa"), 1);
  EXPECT_EQ(SpellingDistance("sfoa", "sofa"), 1) << "neighbours exchanged are one mistake";
  EXPECT_EQ(SpellingDistance("kitten", "sitting"), 3);
}

TEST(NearestName, FindsWhatWasMeant) {
  const Names commands = {"map", "maps", "submaps", "query", "edit", "export"};
  EXPECT_EQ(NearestName("mpas", commands), "maps");
  EXPECT_EQ(NearestName("QUREY", commands), "query");
  EXPECT_EQ(NearestName("submap", commands), "submaps");
  EXPECT_EQ(NearestName("exp", commands), "export") << "it begins so";
  EXPECT_EQ(NearestName("fly", commands), "");
  EXPECT_EQ(NearestName("x", Names{"y"}), "") << "all of it is other letters";
  EXPECT_EQ(NearestName("", commands), "");
  EXPECT_EQ(NearestName("sofa", {}), "");
  EXPECT_EQ(NearestName("sofx", Names{"", "sofb", "sofa"}), "sofb") << "of equals the first";
}

TEST(NearestName, LooksAtNoMoreThanItSays) {
  Names many(1000, "nothing like it");
  many.emplace_back("sofa");
  EXPECT_EQ(NearestName("sofaa", many), "");
  EXPECT_EQ(NearestName(std::string(41, 'a'), Names{std::string(41, 'a')}), "");
}

TEST(DidYouMean, IsTheEndOfAMessage) {
  EXPECT_EQ(DidYouMean("sofaa", Names{"sofa"}), "; did you mean 'sofa'?");
  EXPECT_EQ(DidYouMean("rhinoceros", Names{"sofa"}), "");
}

}  // namespace
}  // namespace dhpmap

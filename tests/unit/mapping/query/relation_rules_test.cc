// SPDX-License-Identifier: BSD-3-Clause
// One small scene for each rule of relations.
#include <gtest/gtest.h>

#include "mapping/query/relations.h"
#include "tests/unit/mapping/query/household.h"

namespace dhpmap {
namespace {

using testing::Block;
using testing::Household;
using testing::kIn;
using testing::kNextTo;
using testing::kOn;
using Told = testing::ToldRelations;

bool IsAnywhere(const Eigen::Vector3d&) { return true; }

class RelationRules : public ::testing::Test {
 protected:
  Household home;
  const SubmapId floor = home.AddStuff(testing::Floor());
};

TEST_F(RelationRules, BoxesWithNothingBetweenThemAreNextToEachOther) {
  const SubmapId a = home.Add(Block({-0.3, 0, 0.3}, {0.2, 0.3, 0.3})),
                 b = home.Add(Block({0.3, 0, 0.3}, {0.2, 0.3, 0.3}));
  EXPECT_EQ(testing::ToldOf(home.Build()), (Told{{kOn, a, floor}, {kOn, b, floor}, {kNextTo, a, b}}));
}

TEST_F(RelationRules, NothingIsNextToWhatIsBehindAWall) {
  const SubmapId a = home.Add(Block({-0.4, 0, 0.3}, {0.2, 0.3, 0.3})),
                 b = home.Add(Block({0.4, 0, 0.3}, {0.2, 0.3, 0.3}));
  home.AddStuff(Block({0, 0, 0.8}, {0.05, 2.2, 1}));
  EXPECT_EQ(testing::ToldOf(home.Build()), (Told{{kOn, a, floor}, {kOn, b, floor}}));
}

TEST_F(RelationRules, NorBehindAWallThatNobodyHasSeenWhereTheyStandAtIt) {
  const SubmapId a = home.Add(Block({-0.3, 0, 0.3}, {0.2, 0.3, 0.3})),
                 b = home.Add(Block({0.3, 0, 0.3}, {0.2, 0.3, 0.3}));
  home.AddStuff(Block({0, 0, 0.8}, {0.05, 2.2, 1}));
  home.Hide([](const Eigen::Vector3d& p) { return std::abs(p.x()) < 0.15 && std::abs(p.y()) < 0.5 && p.z() < 0.8; });
  home.LookThrough([](const Eigen::Vector3d& p) { return std::abs(p.x()) > 0.15; });
  EXPECT_EQ(testing::ToldOf(home.Build()), (Told{{kOn, a, floor}, {kOn, b, floor}}));
}

TEST_F(RelationRules, NorBehindSomethingElse) {
  const SubmapId a = home.Add(Block({-0.3, 0, 0.3}, {0.15, 0.3, 0.3})),
                 b = home.Add(Block({0.3, 0, 0.3}, {0.15, 0.3, 0.3})),
                 between = home.Add(Block({0, 0, 0.4}, {0.05, 0.6, 0.4}));
  const Told told = testing::ToldOf(home.Build());
  EXPECT_TRUE(told.contains({kNextTo, a, between}));
  EXPECT_TRUE(told.contains({kNextTo, b, between}));
  EXPECT_FALSE(told.contains({kNextTo, a, b}));
}

TEST_F(RelationRules, ASofaStandsOnTheFloorAlthoughNobodyHasSeenBelowIt) {
  const SubmapId sofa = home.Add(Block({0, 0, 0.5}, {0.8, 0.4, 0.3}));  // from 0.2 m on; its feet are thin
  home.Hide([](const Eigen::Vector3d& p) { return std::abs(p.x()) < 0.8 && std::abs(p.y()) < 0.4 && p.z() < 0.4; });
  home.LookThrough(
      [](const Eigen::Vector3d& p) { return std::abs(p.x()) > 0.8 || std::abs(p.y()) > 0.4 || p.z() > 0.8; });
  EXPECT_EQ(testing::ToldOf(home.Build()), (Told{{kOn, sofa, floor}}));
}

TEST_F(RelationRules, WhatHangsOverTheFloorAtAWallIsSeenToHang) {
  home.AddStuff(Block({0, 0.6, 0.8}, {2.2, 0.1, 1}));
  const SubmapId cabinet = home.Add(Block({0, 0.3, 0.7}, {0.4, 0.2, 0.3}));  // from 0.4 m on
  home.LookThrough(IsAnywhere);
  const Told told = testing::ToldOf(home.Build());
  EXPECT_TRUE(told.empty()) << told.size();
  EXPECT_NE(cabinet, floor);
}

TEST_F(RelationRules, APictureRightAboveBooksHangs) {
  home.AddStuff(Block({0, 0.6, 0.8}, {2.2, 0.1, 1}));
  const SubmapId books = home.Add(Block({0.2, 0.35, 0.25}, {0.15, 0.1, 0.25}));
  const SubmapId picture = home.Add(Block({0, 0.47, 0.9}, {0.5, 0.03, 0.32}));  // 8 cm above them
  home.LookThrough(IsAnywhere);
  const Told told = testing::ToldOf(home.Build());
  EXPECT_TRUE(told.contains({kOn, books, floor}));
  EXPECT_FALSE(told.contains({kOn, picture, books}));
}

TEST_F(RelationRules, APlantInACornerIsNotInTheWall) {
  const SubmapId walls = home.AddStuff(testing::Room({0, 0, 1}, {1, 1, 5}));
  const SubmapId plant = home.Add(Block({0.75, 0.75, 0.4}, {0.2, 0.2, 0.4}));
  const Told told = testing::ToldOf(home.Build());
  EXPECT_TRUE(told.contains({kOn, plant, floor}));
  EXPECT_FALSE(told.contains({kIn, plant, walls}));
}

TEST_F(RelationRules, ACupInACrateInAShelfIsInTheCrate) {
  const SubmapId shelf = home.Add(testing::Shelf({0, 1, 0}));
  const SubmapId crate = home.Add(testing::Crate({0, 0.97, 0.68}, 0.2, 0.3));
  const SubmapId cup = home.Add(Block({0, 0.97, 0.86}, {0.06, 0.06, 0.08}));
  EXPECT_EQ(
      testing::ToldOf(home.Build()),
      (Told{{kOn, shelf, floor}, {kOn, crate, shelf}, {kIn, crate, shelf}, {kOn, cup, crate}, {kIn, cup, crate}}));
}

TEST_F(RelationRules, WhatLiesUnderATableIsNotInIt) {
  const SubmapId table = home.Add(testing::Table({0, 0, 0}, {0.6, 0.4}, 0.8));
  const SubmapId ball = home.Add(testing::Ball({0, 0, 0.2}, 0.2));
  const Told told = testing::ToldOf(home.Build());
  EXPECT_TRUE(told.contains({kOn, ball, floor}));
  EXPECT_FALSE(told.contains({kIn, ball, table}));
}

TEST_F(RelationRules, AThingOnThinLegsStandsOnWhatIsBelowThem) {
  const SubmapId table = home.Add(testing::Table({0, 0, 0}, {0.9, 0.7}, 0.8));
  EXPECT_EQ(testing::ToldOf(home.Build()), (Told{{kOn, table, floor}}));
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/relations.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/mapping/query/household.h"

namespace dhpmap {
namespace {

using testing::Chair;
using testing::Household;
using testing::Shelf;
using testing::Table;
using Told = testing::ToldRelations;

using testing::kIn;
using testing::kNextTo;
using testing::kOn;

class Furnished : public ::testing::Test {
 protected:
  Household home;
  const SubmapId floor = home.AddStuff(testing::Floor());
  const SubmapId table = home.Add(Table({0, 0, 0}, {0.6, 0.4}, 0.8));
  const SubmapId cup = home.Add(testing::Block({0.2, 0.1, 0.9}, {0.1, 0.1, 0.1}));
  const SubmapId chair = home.Add(Chair({-0.75, 0, 0}));  // its seat half under the table
  const SubmapId shelf = home.Add(Shelf({0, 1.5, 0}));
  const SubmapId book = home.Add(testing::Block({0.1, 1.48, 0.85}, {0.08, 0.15, 0.17}));
  const SubmapId basket = home.Add(testing::Block({0.1, 0, 0.2}, {0.2, 0.2, 0.2}));  // under the table
  const SubmapId lamp = home.Add(testing::Ball({0.2, -0.2, 1.4}, 0.15));             // hangs over it
};

TEST_F(Furnished, IsToldAsPeopleWouldTellIt) {
  const Told told = testing::ToldOf(home.Build());
  const Told on_and_in = [&told] {
    Told found;
    for (const auto& relation : told) {
      if (std::get<0>(relation) != kNextTo) found.insert(relation);
    }
    return found;
  }();
  EXPECT_EQ(on_and_in, (Told{{kOn, table, floor},
                             {kOn, chair, floor},
                             {kOn, shelf, floor},
                             {kOn, basket, floor},
                             {kOn, cup, table},
                             {kOn, book, shelf},
                             {kIn, book, shelf}}));
  EXPECT_TRUE(told.contains({kNextTo, table, chair})) << "although their boxes overlap";
  EXPECT_TRUE(told.contains({kNextTo, table, basket})) << "although it is in the table's box";
  for (const SubmapId id : {cup, book, lamp}) {
    EXPECT_FALSE(told.contains({kNextTo, std::min(id, table), std::max(id, table)})) << id.value;
  }
  EXPECT_FALSE(told.contains({kNextTo, chair, book}));
}

TEST_F(Furnished, TheNumbersAreThoseOfTheScene) {
  std::shared_ptr<const MapSurfaces> surfaces;
  for (const Relation& relation : testing::FindIn(home.Build(), surfaces)) {
    const SubmapId subject = relation.subject->id(), object = relation.object->id();
    if (relation.kind == kOn) {
      EXPECT_GE(relation.support, 0.3);
      EXPECT_LE(relation.support, 1);
      EXPECT_LE(relation.gap_m, 2 * testing::kSceneVoxel_m);
    }
    if (relation.kind == kIn) {
      EXPECT_GE(relation.enclosure, 0.65);
      EXPECT_LT(relation.enclosure, 1) << "it is open to the front";
    }
    if (relation.kind == kNextTo && subject == table && object == basket) {
      // Its top is 0.3 m below the board, its side 0.19 m from the legs.
      EXPECT_NEAR(relation.gap_m, std::hypot(0.19, 0.09), 0.06);
      EXPECT_GT(relation.height_share, 0.95);
    }
  }
}

TEST_F(Furnished, OfOneObjectAndOfOneKindOnly) {
  Map& map = home.Build();
  const Told all = testing::ToldOf(map), of_table = testing::ToldOf(map, {.submap = table});
  Told expected;
  for (const auto& [kind, subject, object] : all) {
    if (subject == table || object == table) expected.emplace(kind, subject, object);
  }
  EXPECT_EQ(of_table, expected);
  const Told in = testing::ToldOf(map, {.kinds = std::vector{kIn}});
  EXPECT_EQ(in, (Told{{kIn, book, shelf}}));
  EXPECT_EQ(testing::ToldOf(map, {.most = 2}).size(), 2u);
  RelationQuestion without;
  without.scope.excluded_submaps = {table};
  for (const auto& relation : testing::ToldOf(map, without)) {
    EXPECT_NE(std::get<1>(relation), table);
    EXPECT_NE(std::get<2>(relation), table);
  }
}

TEST_F(Furnished, PagesTogetherAreAllRelations) {
  Map& map = home.Build();
  std::shared_ptr<const MapSurfaces> surfaces;
  const auto all = testing::FindIn(map, surfaces);
  ASSERT_GT(all.size(), 2u);
  RelationQuestion question;
  for (std::size_t i = 0; i < all.size(); ++i) {
    question.most = i + 1;
    const auto rest = FindRelations(*surfaces, question);
    ASSERT_FALSE(rest.empty());
    EXPECT_EQ(rest.front().subject->id(), all[i].subject->id());
    EXPECT_EQ(rest.front().object->id(), all[i].object->id());
    EXPECT_EQ(rest.front().kind, all[i].kind);
    question.after = RelationPlace{all[i].subject->id(), all[i].object->id(), all[i].kind};
  }
  EXPECT_TRUE(FindRelations(*surfaces, question).empty());
}

TEST_F(Furnished, MovedAndTurnedTogetherTheyAreToldTheSame) {
  Map& map = home.Build();
  const Told before = testing::ToldOf(map, {.kinds = std::vector{kOn, kIn}});
  std::mt19937 random(3);
  const Transform T = testing::RandomPose(random, 5);
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) ids.push_back(submap->id());
  for (const SubmapId id : ids) map.FindMutable(id)->mutable_info().T_map_submap = T;
  EXPECT_EQ(testing::ToldOf(map, {.T_map_query = T, .kinds = std::vector{kOn, kIn}}), before);
  map.FindMutable(cup)->mutable_info().T_map_submap = T * Eigen::Translation3d(0, 0, 0.3);
  const Told lifted = testing::ToldOf(map, {.T_map_query = T, .submap = cup, .kinds = std::vector{kOn, kIn}});
  EXPECT_TRUE(lifted.empty()) << "it hangs in the air";
}

}  // namespace
}  // namespace dhpmap

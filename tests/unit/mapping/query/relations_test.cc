// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/relations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::SolidDistance;

SolidDistance Union(std::vector<SolidDistance> parts) {
  return [parts = std::move(parts)](const Eigen::Vector3d& p) {
    double least = parts[0](p);
    for (const SolidDistance& part : parts) least = std::min(least, part(p));
    return least;
  };
}

/// A board on four legs, its top at `height_m`.
SolidDistance Table(const Eigen::Vector3d& foot_m, const Eigen::Vector2d& half_m, double height_m) {
  const Eigen::Vector3d top = foot_m + Eigen::Vector3d(0, 0, height_m - 0.05);
  std::vector<SolidDistance> parts = {testing::Block(top, {half_m.x(), half_m.y(), 0.05})};
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1}) {
      const Eigen::Vector3d leg(x * (half_m.x() - 0.06), y * (half_m.y() - 0.06), height_m / 2);
      parts.push_back(testing::Block(foot_m + leg, {0.05, 0.05, height_m / 2}));
    }
  }
  return Union(std::move(parts));
}

/// Open to the front (-y): two sides, a back, and boards at 0, 0.6 and 1.2 m.
SolidDistance Shelf(const Eigen::Vector3d& foot_m) {
  std::vector<SolidDistance> parts;
  for (const double x : {-0.45, 0.45})
    parts.push_back(testing::Block(foot_m + Eigen::Vector3d(x, 0, 0.6), {0.04, 0.25, 0.65}));
  parts.push_back(testing::Block(foot_m + Eigen::Vector3d(0, 0.25, 0.6), {0.45, 0.04, 0.65}));
  for (const double z : {0.0, 0.6, 1.2})
    parts.push_back(testing::Block(foot_m + Eigen::Vector3d(0, 0, z + 0.04), {0.45, 0.25, 0.04}));
  return Union(std::move(parts));
}

SolidDistance Chair(const Eigen::Vector3d& foot_m) {
  return Union(
      {Table(foot_m, {0.22, 0.22}, 0.45), testing::Block(foot_m + Eigen::Vector3d(-0.2, 0, 0.65), {0.04, 0.22, 0.25})});
}

/// Objects of which each has the voxels that are nearest to it, as after label management.
class Household {
 public:
  SubmapId Add(const SolidDistance& distance, Panoptic panoptic = Panoptic::kThing) {
    solids_.push_back(distance);
    Submap& submap = testing::AddThing(map_, panoptic == Panoptic::kThing ? ClassId(1) : ClassId(3));
    submap.mutable_info().panoptic = panoptic;
    ids_.push_back(submap.id());
    return submap.id();
  }
  Map& Build() {
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      const auto is_mine = [this, i](const Eigen::Vector3d& p) {
        for (std::size_t j = 0; j < solids_.size(); ++j) {
          if (j != i && (solids_[j](p) < solids_[i](p) || (solids_[j](p) == solids_[i](p) && j < i))) return false;
        }
        return true;
      };
      testing::ObserveBand(*map_.FindMutable(ids_[i]), solids_[i],
                           {Eigen::Vector3d(-2, -2, -0.2), Eigen::Vector3d(2, 2, 1.7)}, is_mine);
    }
    return map_;
  }

 private:
  Map map_{testing::SceneInfo()};
  std::vector<SolidDistance> solids_;
  std::vector<SubmapId> ids_;
};

using Told = std::set<std::tuple<RelationKind, SubmapId, SubmapId>>;

std::vector<Relation> Find(Map& map, std::shared_ptr<const MapSurfaces>& surfaces, const RelationQuestion& question) {
  SurfaceCache cache(std::size_t{1} << 30);
  surfaces = cache.Of(map.Publish(0));
  return FindRelations(*surfaces, question);
}

Told FindAll(Map& map, const RelationQuestion& question = {}) {
  std::shared_ptr<const MapSurfaces> surfaces;
  Told told;
  for (const Relation& relation : Find(map, surfaces, question)) {
    EXPECT_TRUE(told.emplace(relation.kind, relation.subject->id(), relation.object->id()).second) << "told once";
  }
  return told;
}

constexpr RelationKind kOn = RelationKind::kOn, kIn = RelationKind::kIn, kNextTo = RelationKind::kNextTo;

class Furnished : public ::testing::Test {
 protected:
  Household home;
  const SubmapId floor = home.Add([](const Eigen::Vector3d& p) { return p.z(); }, Panoptic::kStuff);
  const SubmapId table = home.Add(Table({0, 0, 0}, {0.6, 0.4}, 0.8));
  const SubmapId cup = home.Add(testing::Block({0.2, 0.1, 0.9}, {0.1, 0.1, 0.1}));
  const SubmapId chair = home.Add(Chair({-0.75, 0, 0}));  // its seat half under the table
  const SubmapId shelf = home.Add(Shelf({0, 1.5, 0}));
  const SubmapId book = home.Add(testing::Block({0.1, 1.48, 0.85}, {0.08, 0.15, 0.17}));
  const SubmapId basket = home.Add(testing::Block({0.1, 0, 0.2}, {0.2, 0.2, 0.2}));  // under the table
  const SubmapId lamp = home.Add(testing::Ball({0.2, -0.2, 1.4}, 0.15));             // hangs over it
};

TEST_F(Furnished, IsToldAsPeopleWouldTellIt) {
  const Told told = FindAll(home.Build());
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
  for (const Relation& relation : Find(home.Build(), surfaces, {})) {
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
  const Told all = FindAll(map), of_table = FindAll(map, {.submap = table});
  Told expected;
  for (const auto& [kind, subject, object] : all) {
    if (subject == table || object == table) expected.emplace(kind, subject, object);
  }
  EXPECT_EQ(of_table, expected);
  const Told in = FindAll(map, {.kinds = std::vector{kIn}});
  EXPECT_EQ(in, (Told{{kIn, book, shelf}}));
  EXPECT_EQ(FindAll(map, {.most = 2}).size(), 2u);
  RelationQuestion without;
  without.scope.excluded_submaps = {table};
  for (const auto& relation : FindAll(map, without)) {
    EXPECT_NE(std::get<1>(relation), table);
    EXPECT_NE(std::get<2>(relation), table);
  }
}

TEST_F(Furnished, MovedAndTurnedTogetherTheyAreToldTheSame) {
  Map& map = home.Build();
  const Told before = FindAll(map, {.kinds = std::vector{kOn, kIn}});
  std::mt19937 random(3);
  const Transform T = testing::RandomPose(random, 5);
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) ids.push_back(submap->id());
  for (const SubmapId id : ids) map.FindMutable(id)->mutable_info().T_map_submap = T;
  EXPECT_EQ(FindAll(map, {.T_map_query = T, .kinds = std::vector{kOn, kIn}}), before);
  map.FindMutable(cup)->mutable_info().T_map_submap = T * Eigen::Translation3d(0, 0, 0.3);
  const Told lifted = FindAll(map, {.T_map_query = T, .submap = cup, .kinds = std::vector{kOn, kIn}});
  EXPECT_TRUE(lifted.empty()) << "it hangs in the air";
}

}  // namespace
}  // namespace dhpmap

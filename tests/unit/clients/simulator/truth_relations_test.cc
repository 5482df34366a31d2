// SPDX-License-Identifier: BSD-3-Clause
#include "clients/simulator/truth_relations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>

#include "clients/simulator/furniture.h"
#include "clients/simulator/surface_rays.h"
#include "tests/unit/clients/simulator/recorded_apartment.h"

namespace dhpmap::simulator {
namespace {

constexpr Material kTestWood{Material::Pattern::kPlain, 0x806040};
constexpr ObjectClass kThing = ObjectClass::kBox;

/// Each as text: "box_001 ON floor_001".
std::set<std::string> TextsOf(std::span<const Instance> instances, std::span<const Solid> solids) {
  std::set<std::string> texts;
  for (const TruthRelation& relation : RelationsOf(instances, solids)) {
    const std::string text =
        instances[relation.subject].name + " " + NameOf(relation.kind) + " " + instances[relation.object].name;
    EXPECT_TRUE(texts.insert(text).second) << "told once: " << text;
  }
  return texts;
}
std::set<std::string> TextsOf(const SceneBuilder& scene) { return TextsOf(scene.instances(), scene.solids()); }

class TruthRelations : public ::testing::Test {
 protected:
  void SetUp() override {
    scene.BeginStuff(ObjectClass::kFloor);
    scene.Box({0, 0, -0.1}, {8, 8, 0.2}, kTestWood);
  }
  void AddBlock(const Eigen::Vector3d& center_m, const Eigen::Vector3d& size_m) {
    scene.BeginThing(kThing, {});
    scene.Box(center_m, size_m, kTestWood);
  }
  void AddWall(double x_m) {
    scene.BeginStuff(ObjectClass::kWall);
    scene.Box({x_m, 0, 1}, {0.1, 8, 2}, kTestWood);
  }
  SceneBuilder scene;
};

TEST_F(TruthRelations, AThingIsOnWhatMostOfItsFeetStandOn) {
  AddBlock({0, 0, 0.5}, {1, 1, 1});
  AddBlock({0.4, 0, 1.1}, {0.4, 0.2, 0.2});  // 0.3 m of 0.4 over the first
  AddBlock({0, 3, 0.5}, {1, 1, 1});
  AddBlock({0.8, 3, 1.1}, {1, 0.2, 0.2});  // 0.2 m of 1 only
  EXPECT_EQ(TextsOf(scene), (std::set<std::string>{"box_001 ON floor_001", "box_002 ON box_001", "box_003 ON floor_001",
                                                   "box_004 HANGS_ON box_003"}));
}

TEST_F(TruthRelations, WhatHangsAtAWallIsOnNothing) {
  AddWall(0);
  AddBlock({0.1, 0, 1.5}, {0.05, 0.6, 0.4});
  AddBlock({1.5, 0, 1.5}, {0.05, 0.6, 0.4});  // in the air
  EXPECT_EQ(TextsOf(scene), (std::set<std::string>{"box_001 HANGS_ON wall_001"}));
}

TEST_F(TruthRelations, AThingIsInAShelfOrACrateAndOfTwoInTheInnerOne) {
  AddBookshelf(scene, {0, 0, 0, 0}, 1.2, 1.9, 5);  // as the apartment's
  scene.BeginThing(ObjectClass::kBin, {});         // a crate in its lowest compartment: bottom and four sides
  scene.Box({0, 0, 0.04}, {0.24, 0.2, 0.02}, kTestWood);
  for (const double side : {-1.0, 1.0}) {
    scene.Box({side * 0.115, 0, 0.12}, {0.01, 0.2, 0.16}, kTestWood);
    scene.Box({0, side * 0.095, 0.12}, {0.24, 0.01, 0.16}, kTestWood);
  }
  AddBlock({0, 0, 0.1}, {0.1, 0.1, 0.1});
  AddBlock({0.3, 0, 2.0}, {0.2, 0.2, 0.2});  // on top of it
  const auto told = TextsOf(scene);
  EXPECT_TRUE(told.contains("bin_001 IN bookshelf_001"));
  EXPECT_TRUE(told.contains("box_001 IN bin_001"));
  EXPECT_FALSE(told.contains("box_001 IN bookshelf_001"));
  EXPECT_TRUE(told.contains("box_002 ON bookshelf_001"));
  EXPECT_FALSE(told.contains("box_002 IN bookshelf_001"));
}

TEST_F(TruthRelations, NothingIsNextToWhatIsBehindAWallOrSomethingElse) {
  AddBlock({0.25, 0, 0.5}, {0.3, 1, 1});
  AddBlock({-0.25, 0, 0.5}, {0.3, 1, 1});
  EXPECT_TRUE(TextsOf(scene).contains("box_001 NEXT_TO box_002"));
  SceneBuilder with_thing = scene;
  with_thing.BeginThing(ObjectClass::kPouf, {});
  with_thing.Box({0, 0, 0.6}, {0.1, 1.2, 1.2}, kTestWood);
  EXPECT_FALSE(TextsOf(with_thing).contains("box_001 NEXT_TO box_002"));
  EXPECT_TRUE(TextsOf(with_thing).contains("box_001 NEXT_TO pouf_001"));
  AddWall(0);
  EXPECT_FALSE(TextsOf(scene).contains("box_001 NEXT_TO box_002"));
}

TEST_F(TruthRelations, NorToWhatIsFarOrMostlyHigher) {
  AddBlock({0, 0, 0.5}, {1, 1, 1});
  AddBlock({1.49, 0, 0.5}, {1, 1, 1});   // 0.49 m away
  AddBlock({0, 1.51, 0.5}, {1, 1, 1});   // 0.51 m
  AddBlock({-1.2, 0, 1.01}, {1, 1, 1});  // on a level of its own but for 0.49 m
  std::set<std::string> next;
  for (const std::string& text : TextsOf(scene)) {
    if (text.find("NEXT_TO") != std::string::npos) next.insert(text);
  }
  EXPECT_EQ(next, (std::set<std::string>{"box_001 NEXT_TO box_002"}));
}

TEST(TruthRelationsOfTheApartment, EverythingIsHeldBySomething) {
  const auto& apartment = testing::Apartment();
  const auto relations = RelationsOf(apartment.instances(), apartment.solids());
  for (const Instance& instance : apartment.instances()) {
    if (instance.id == 0 || !InfoOf(instance.object_class).is_thing) continue;
    EXPECT_TRUE(std::any_of(relations.begin(), relations.end(), [&](const TruthRelation& relation) {
      return relation.subject == instance.id &&
             (relation.kind == TruthRelationKind::kOn || relation.kind == TruthRelationKind::kHangsOn);
    })) << instance.name;
  }
}

TEST(SurfaceRays, PointsLieOnTheSurfaceAndNoFartherApartThanAsked) {
  Solid box;
  box.size_m = {0.1, 0.2, 0.3};
  const Solid* const solids[] = {&box};
  const auto points = PointsOn(solids, 0.02);
  for (const Eigen::Vector3d& p : points) ASSERT_NEAR(box.Distance(p), 0, 1e-9);
  for (const Eigen::Vector3d& corner :
       {Eigen::Vector3d(0.1, 0.2, 0.3), Eigen::Vector3d(-0.1, -0.2, -0.3), Eigen::Vector3d(0.1, 0.011, 0.013)}) {
    double nearest_m = 1;
    for (const Eigen::Vector3d& p : points) nearest_m = std::min(nearest_m, (p - corner).norm());
    EXPECT_LE(nearest_m, 0.02 / std::sqrt(2));
  }
}

}  // namespace
}  // namespace dhpmap::simulator

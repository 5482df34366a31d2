// SPDX-License-Identifier: BSD-3-Clause
// What parts of a robot may touch: wheels the floor, and nobody anything else.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "mapping/query/near_triangles.h"
#include "mapping/query/trajectory_query.h"
#include "mapping/query/unseen_voxels.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kIgnoringUnknown;
using testing::kSceneVoxel_m;
using testing::SurfacesOf;

constexpr SubmapId kFloor(1), kWall(2);
constexpr double kWallX_m = 0.9;

/// A floor at z = 0 from x = 0 to a wall at x = 0.9, seen from above: all is free there up to 1.6 m, but for what is
/// around (0.2, 0.2, 0.2), where nobody has looked. Under the floor and behind the wall nobody has seen more than their
/// bands.
Map FloorAndWall() {
  Map map(testing::SceneInfo());
  const auto is_nearer_to_floor = [](const Eigen::Vector3d& p) { return std::abs(p.z()) < std::abs(kWallX_m - p.x()); };
  testing::ObserveBand(
      testing::AddThing(map, ClassId(3)), [](const Eigen::Vector3d& p) { return p.z(); },
      {Eigen::Vector3d(0, 0, -0.3), Eigen::Vector3d(1.2, 1.59, 0.3)},
      [&](const Eigen::Vector3d& p) { return p.x() < kWallX_m && is_nearer_to_floor(p); });
  testing::ObserveBand(
      testing::AddThing(map, ClassId(2)), [](const Eigen::Vector3d& p) { return kWallX_m - p.x(); },
      {Eigen::Vector3d(0.6, 0, 0), Eigen::Vector3d(1.2, 1.59, 1.5)},
      [&](const Eigen::Vector3d& p) { return !is_nearer_to_floor(p); });
  FreeBlocks seen;
  for (int x = 0; x < 2; ++x) {
    for (int y = 0; y < 4; ++y) {
      for (int z = 0; z < 4; ++z) seen.full |= std::uint64_t{1} << CellOf({x, y, z});
    }
  }
  seen.full &= ~(std::uint64_t{1} << CellOf({0, 0, 0}));
  map.mutable_free_space().Add({0, 0, 0}, seen, 1);
  return map;
}

Body BallOf(const Eigen::Vector3d& center_m, double radius_m) { return Capsule{center_m, center_m, radius_m}; }

BodyOptions MayTouch(std::vector<SubmapId> ids, BodyOptions options = {}) {
  options.scope.may_touch = std::move(ids);
  return options;
}

TEST(MayTouch, AWheelStandsOnTheFloorHoweverDeepItDipsAndStillMeetsTheWall) {
  Map map = FloorAndWall();
  const auto surfaces = SurfacesOf(map);
  const BodyQuery nobody(surfaces, {}), wheel(surfaces, MayTouch({kFloor}));
  for (const double dip_m : {0.01, 0.1, 0.25, 0.35}) {  // what lies deeper than 0.15 nobody has seen
    const Body body = BallOf({0.5, 0.8, 0.36 - dip_m}, 0.36);
    ASSERT_FALSE(nobody.Check(body).contacts.empty());
    EXPECT_EQ(nobody.Check(body).contacts[0].submap->id, kFloor);
    EXPECT_TRUE(nobody.Test(body).is_colliding);
    EXPECT_FALSE(wheel.Test(body).is_colliding) << dip_m;
    EXPECT_FALSE(wheel.Check(body).is_unknown) << dip_m;
    EXPECT_TRUE(wheel.Check(body).contacts.empty());
  }
  const OrientedBox track{Transform(Eigen::Translation3d(0.5, 0.8, 0)), {0.2, 0.2, 0.3}};
  EXPECT_EQ(nobody.Check(track).contacts.at(0).submap->id, kFloor);
  EXPECT_FALSE(wheel.Test(track).is_colliding);
  for (const Body& at_wall : {BallOf({0.7, 0.8, 0.2}, 0.25), Body(Capsule{{0.5, 0.8, 0.1}, {0.85, 0.8, 0.1}, 0.15})}) {
    EXPECT_TRUE(wheel.Test(at_wall).is_colliding);
    const BodyAnswer all = wheel.Check(at_wall, 10);
    ASSERT_EQ(all.contacts.size(), 1u) << "not the floor, which they touch as well";
    EXPECT_EQ(all.contacts[0].submap->id, kWall);
  }
}

TEST(MayTouch, LeavingTheFloorOutMakesItUnknownWhileToMayTouchItDoesNot) {
  Map map = FloorAndWall();
  const auto surfaces = SurfacesOf(map);
  BodyOptions excluded;
  excluded.scope.excluded_submaps = {kFloor};
  const Body wheel = BallOf({0.5, 0.8, 0.05}, 0.1);
  EXPECT_TRUE(BodyQuery(surfaces, excluded).Check(wheel).is_unknown);
  EXPECT_TRUE(BodyQuery(surfaces, excluded).Test(wheel).is_colliding);
  EXPECT_FALSE(BodyQuery(surfaces, MayTouch({kFloor})).Test(wheel).is_colliding);
}

TEST(MayTouch, OnlyTheUnseenInsideOfWhatMayBeTouchedIsOutOfTheWay) {
  Map map = FloorAndWall();
  const auto surfaces = SurfacesOf(map);
  const QueryWorld floor(surfaces, MayTouch({kFloor}).scope), wall(surfaces, MayTouch({kWall}).scope);
  int num_under = 0, num_behind = 0, num_beside = 0, num_hidden = 0;
  const auto is = [](const QueryWorld& world, VoxelIndex voxel) {
    return !world.IsSeen(voxel) && IsAllowed(world, voxel, 3, nullptr);
  };
  for (int z = -12; z < 24; ++z) {
    for (int x = -8; x < 30; ++x) {
      for (const int y : {3, 12, 20}) {
        const VoxelIndex voxel{x, y, z};
        const Eigen::Vector3d p = VoxelCentre(voxel, kSceneVoxel_m);
        if (floor.IsSeen(voxel)) continue;
        const double to_floor_m = std::abs(p.z()), to_wall_m = std::abs(kWallX_m - p.x());
        constexpr double kUnclear_m = 1.5 * kSceneVoxel_m;  // near the edge where they meet
        if (p.z() < 0 && p.x() > 2 * kSceneVoxel_m && p.x() < kWallX_m && to_wall_m > to_floor_m + kUnclear_m) {
          EXPECT_TRUE(is(floor, voxel)) << p.transpose();
          EXPECT_FALSE(is(wall, voxel)) << p.transpose();
          ++num_under;
        } else if (p.z() > 0 && p.z() < 1.4 && p.x() > kWallX_m && to_floor_m > to_wall_m + kUnclear_m) {
          EXPECT_FALSE(is(floor, voxel)) << p.transpose();
          EXPECT_TRUE(is(wall, voxel)) << p.transpose();
          ++num_behind;
        } else if (p.x() < -kSceneVoxel_m) {
          EXPECT_FALSE(is(floor, voxel)) << "beyond its end: " << p.transpose();
          ++num_beside;
        } else if (p.z() > 0 && p.x() > 0 && p.x() < 0.4) {
          EXPECT_FALSE(is(floor, voxel)) << "in front of it: " << p.transpose();
          ++num_hidden;
        }
      }
    }
  }
  EXPECT_GT(num_under, 100);
  EXPECT_GT(num_behind, 50);
  EXPECT_GT(num_beside, 100);
  EXPECT_GT(num_hidden, 20);
}

TEST(MayTouch, UnseenSpaceAboveTheFloorAndBeyondItsEndIsInTheWayOfWheels) {
  Map map = FloorAndWall();
  const auto surfaces = SurfacesOf(map);
  const BodyQuery wheel(surfaces, MayTouch({kFloor}));
  for (const Eigen::Vector3d& center : {Eigen::Vector3d(0.2, 0.2, 0.2), Eigen::Vector3d(0.05, 0.8, 0.15)}) {
    const BodyAnswer answer = wheel.Check(BallOf(center, 0.2));
    EXPECT_TRUE(answer.is_colliding) << center.transpose();
    EXPECT_TRUE(answer.is_unknown);
    ASSERT_EQ(answer.contacts.size(), 1u);
    EXPECT_EQ(answer.contacts[0].submap, nullptr);
  }
}

TEST(MayTouch, SurfacesOfOthersStayAsTheyAre) {
  Map map = FloorAndWall();  // whose surfaces meet in cells that belong to both
  const auto surfaces = SurfacesOf(map);
  using Corner = std::tuple<float, float, float>;
  const auto triangles = [&](const QueryScope& scope) {
    std::set<std::pair<std::size_t, std::vector<Corner>>> found;
    const QueryWorld world(surfaces, scope);
    VisitNear(world, OrientedBox{Transform::Identity(), {3, 3, 3}}, [&](const NearTriangle<OrientedBox>& near) {
      std::vector<Corner> corners;
      for (const Eigen::Vector3f& c : near.triangle) {
        const Eigen::Vector3f p = near.InMap(c.cast<double>()).cast<float>();
        corners.emplace_back(p.x(), p.y(), p.z());
      }
      found.emplace(near.number, std::move(corners));
      return true;
    });
    return found;
  };
  auto others = triangles({});
  const std::size_t num_all = others.size();
  std::erase_if(others, [&](const auto& t) { return surfaces->index().entries()[t.first].submap().id() == kFloor; });
  QueryScope may_touch;
  may_touch.may_touch = {kFloor};
  EXPECT_EQ(triangles(may_touch), others);
  EXPECT_GT(others.size(), 100u);
  EXPECT_LT(others.size(), num_all);
}

TEST(MayTouch, SpheresMeetWhatIsLeftAsAllTrianglesSay) {
  Map map = testing::DisarrayedRoom(5);
  const auto surfaces = SurfacesOf(map);
  const std::vector<SubmapId> touchable = {SubmapId(4), SubmapId(1), SubmapId(99)};  // in no order; one is not there
  const BodyOptions options = MayTouch(touchable, kIgnoringUnknown);
  const testing::AllTriangles others(*map.published(), [&](const SubmapInfo& info) {
    return std::find(touchable.begin(), touchable.end(), info.id) == touchable.end();
  });
  const BodyQuery query(surfaces, options);
  int num_colliding = 0, num_clear = 0;
  for (const Eigen::Vector3d& p : testing::RandomPoints(300, 1.4, 3)) {
    constexpr double kRadius_m = 0.2;
    const testing::BruteNearest nearest = others.Nearest(p);
    const BodyAnswer answer = query.Check(BallOf(p, kRadius_m), 10);
    for (const BodyContact& contact : answer.contacts) {
      EXPECT_EQ(std::count(touchable.begin(), touchable.end(), contact.submap->id), 0);
    }
    EXPECT_EQ(query.Test(BallOf(p, kRadius_m)).is_colliding, answer.is_colliding);
    if (nearest.distance_m <= kRadius_m) {
      ASSERT_FALSE(answer.contacts.empty());
      EXPECT_EQ(answer.contacts[0].submap->id, nearest.submap);
    } else if (answer.is_colliding) {
      EXPECT_TRUE(query.InsideOf(p).has_value());
    }
    ++(answer.is_colliding ? num_colliding : num_clear);
  }
  EXPECT_GT(num_colliding, 20);
  EXPECT_GT(num_clear, 100);
}

using Knots = std::vector<SphereKnot>;

Knots RollTo(double y, double z, double radius_m, double to_x) {
  return {{0, {0.5, y, z}, radius_m}, {1, {to_x, y, z}, radius_m}};
}

TEST(MayTouch, EachPartOfARobotHasItsOwnList) {
  Map map = FloorAndWall();
  TrajectoryOptions options;
  options.spheres.lists = {{}, {kFloor}};
  options.spheres.list_of = {1, 0};  // a wheel and a body
  const auto go = [&](double body_z, double to_x) {
    RobotMotion motion;
    motion.spheres = {RollTo(0.8, 0.09, 0.1, to_x), RollTo(0.8, body_z, 0.1, to_x)};
    const auto query = TrajectoryQuery::Make(SurfacesOf(map), options);
    EXPECT_TRUE(query.ok());
    return *query->Check(motion);
  };
  EXPECT_TRUE(go(0.3, 0.7).is_valid);
  const TrajectoryAnswer low = go(0.09, 0.7);
  ASSERT_EQ(low.contacts.size(), 1u);
  EXPECT_EQ(low.contacts[0].sphere, 1u) << "only the wheel may";
  EXPECT_EQ(low.contacts[0].contact.submap->id, kFloor);
  const TrajectoryAnswer wall = go(0.3, 1.5);
  ASSERT_EQ(wall.contacts.size(), 1u);
  EXPECT_EQ(wall.contacts[0].contact.submap->id, kWall);
  EXPECT_NEAR(wall.contacts[0].at, 0.3, 0.01);
  options.spheres = {};
  EXPECT_FALSE(go(0.3, 0.7).is_valid) << "nobody may touch anything";
}

TEST(MayTouch, WhatIsCarriedMayStandOnWhatItMayTouchAlthoughNobodyHasSeenUnderIt) {
  Map map = FloorAndWall();
  const auto box = testing::Block({0.6, 0.8, 0.5}, {0.1, 0.1, 0.1});
  const Submap& thing = testing::AddThing(map);
  testing::ObserveBand(*map.FindMutable(thing.id()), box, testing::CubeAt({0.6, 0.8, 0.5}, 0.3));
  TrajectoryOptions options{.bodies = {}, .attached = {{thing.id(), {kFloor}}}};
  options.bodies.scope.attached = {thing.id()};
  RobotMotion motion;
  motion.attached = {{Transform::Identity(), Transform(Eigen::Translation3d(0, 0, -0.5))}};  // half sunk
  motion.waypoints = {Transform::Identity(), Transform::Identity()};
  const auto check = [&] { return *TrajectoryQuery::Make(SurfacesOf(map), options)->Check(motion); };
  EXPECT_TRUE(check().is_valid);
  options.attached[0].may_touch.clear();
  ASSERT_EQ(check().contacts.size(), 1u);
  EXPECT_EQ(check().contacts[0].contact.submap->id, kFloor);
  EXPECT_NEAR(check().contacts[0].at, 0.4 / 0.5, 0.1);
}

}  // namespace
}  // namespace dhpmap

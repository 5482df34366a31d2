// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/trajectory_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/mapping/query/knots.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kIgnoringUnknown;
using testing::kSceneVoxel_m;
using testing::SurfacesOf;

using Knots = std::vector<SphereKnot>;

/// Nothing in the way before `first`, by looking at very many moments; a touch at it.
void ExpectFirstContact(const Knots& knots, const std::optional<SweepContact>& first, const DistanceQuery& distances) {
  constexpr int kSteps = 300;
  const double end = static_cast<double>(knots.size() - 1);
  for (double at = 0; at <= (first ? first->at : end); at += 1.0 / kSteps) {
    const SphereKnot knot = testing::KnotAt(knots, at);
    EXPECT_GT(distances.At(knot.center_m).distance_m, knot.radius_m - 1e-4)
        << at << " of " << (first ? first->at : end);
  }
  if (!first) return;
  const SphereKnot knot = testing::KnotAt(knots, first->at);
  const SurfaceDistance touched = distances.At(knot.center_m);
  EXPECT_NEAR(std::abs(touched.distance_m), knot.radius_m, 1e-4);
  EXPECT_NEAR((first->contact.point_m - touched.nearest_m).norm(), 0, 2e-2) << "one of those that are as near";
  EXPECT_NEAR((first->contact.point_m - knot.center_m).norm(), knot.radius_m, 1e-4);
  EXPECT_GT(first->contact.normal.dot(knot.center_m - first->contact.point_m), 0.99 * knot.radius_m - 1e-4);
}

TEST(SweepQuery, FindsTheFirstTouchThatDenseSamplingFinds) {
  Map map = testing::FurnishedRoom();
  map.FindMutable(SubmapId(2))->mutable_info().T_map_submap.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
  const auto surfaces = SurfacesOf(map);
  const SweepQuery query(surfaces, kIgnoringUnknown);
  const DistanceQuery distances(surfaces, {});
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  int num_contacts = 0, num_clear = 0;
  for (int round = 0; round < 80; ++round) {
    Knots knots;
    Eigen::Vector3d p = 0.8 * Eigen::Vector3d{unit(random), unit(random), unit(random)};
    for (int h = 0; h < 4; ++h) {
      knots.push_back({static_cast<double>(h), p, 0.1 + 0.05 * unit(random)});
      p += 0.4 * Eigen::Vector3d{unit(random), unit(random), unit(random)};
    }
    const double start_m = distances.At(knots[0].center_m).distance_m;
    const SweepAnswer answer = query.First(knots);
    if (start_m <= knots[0].radius_m) {
      ASSERT_TRUE(answer.first);
      EXPECT_EQ(answer.first->at, 0);
      EXPECT_NEAR(answer.first->contact.depth_m, knots[0].radius_m - start_m, 1e-4);
      continue;
    }
    ExpectFirstContact(knots, answer.first, distances);
    ++(answer.first ? num_contacts : num_clear);
  }
  EXPECT_GT(num_contacts, 10);
  EXPECT_GT(num_clear, 10);
}

/// A sheet at x = 0.3, seen from one side only.
Map SheetMap() {
  Map map(testing::SceneInfo());
  testing::ObserveBand(testing::AddThing(map), [](const Eigen::Vector3d& p) { return 0.3 - p.x(); },
                       {Eigen::Vector3d(0, -1, -1), Eigen::Vector3d(0.6, 1, 1)});
  return map;
}

TEST(SweepQuery, NeverTunnelsThroughAThinSheetHoweverFast) {
  Map map = SheetMap();
  const SweepQuery query(SurfacesOf(map), kIgnoringUnknown);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 200; ++round) {
    const double radius_m = 0.01 + 0.01 * unit(random), speed_m = std::pow(10.0, 1.5 + 1.5 * unit(random));
    const Eigen::Vector3d through{0.3, 0.8 * unit(random), 0.8 * unit(random)};
    const Eigen::Vector3d way = Eigen::Vector3d{1, 0.3 * unit(random), 0.3 * unit(random)} * speed_m;
    const Knots knots = {{0, through - 0.4 * way, radius_m}, {1, through + 0.6 * way, radius_m}};
    const SweepAnswer answer = query.First(knots);
    ASSERT_TRUE(answer.first) << speed_m;
    const double slant = way.norm() / way.x();
    EXPECT_NEAR(answer.first->at, 0.4 - radius_m / way.x(), 2e-3 * radius_m / way.x() * slant + 1e-4 / way.x());
    EXPECT_NEAR(answer.first->contact.normal.x(), -1, 1e-3);
  }
  // Along it, as close as can be.
  const double x = 0.3 - 0.05 - 1e-5;
  EXPECT_FALSE(query.First(Knots{{0, {x, -0.9, 0}, 0.05}, {1, {x, 0.9, 0.1}, 0.05}}).first);
  EXPECT_TRUE(query.First(Knots{{0, {x, -0.9, 0}, 0.05}, {1, {x + 3e-5, 0.9, 0.1}, 0.05}}).first);
}

TEST(SweepQuery, UnseenSpaceIsMetWhenItsFirstVoxelIs) {
  Map map(testing::SceneInfo());
  FreeBlocks seen;
  seen.full = ~std::uint64_t{0};  // 0 to 1.6 m
  map.mutable_free_space().Add({0, 0, 0}, seen, 1);
  const auto surfaces = SurfacesOf(map);
  const Knots knots = {{0, {0.5, 0.525, 0.525}, 0.2}, {1, {1.0, 0.525, 0.525}, 0.2}, {2, {3.0, 0.525, 0.525}, 0.2}};
  const double unseen_at = 1 + (1.625 - 0.2 - 1.0) / 2.0;  // the centre of the first voxel beyond
  const SweepAnswer occupied = SweepQuery(surfaces, {}).First(knots);
  ASSERT_TRUE(occupied.first);
  EXPECT_NEAR(occupied.first->at, unseen_at, 1e-5);
  EXPECT_EQ(occupied.first->contact.submap, nullptr);
  const SweepAnswer reported = SweepQuery(surfaces, {.unknown = UnknownSpace::kReported}).First(knots);
  EXPECT_FALSE(reported.first);
  ASSERT_TRUE(reported.unknown_at);
  EXPECT_NEAR(*reported.unknown_at, unseen_at, 1e-5);
  EXPECT_FALSE(SweepQuery(surfaces, kIgnoringUnknown).First(knots).unknown_at);
  EXPECT_FALSE(SweepQuery(surfaces, {}).First(knots, 1.1).first) << "not until then";
}

TEST(RigidPath, FollowsATurnOnTheSafeSide) {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    const Transform from = testing::RandomPose(random, 1), to = testing::RandomPose(random, 1);
    const std::vector<Transform> waypoints = {from, to};
    const RigidPath path(waypoints, 1.2);
    const Eigen::Vector3d point(0.7, -0.8, 0.2);
    const Knots knots = path.Carried(point, 0.1);
    EXPECT_EQ(knots.front().at, 0);
    EXPECT_EQ(knots.back().at, 1);
    EXPECT_LT(knots[0].radius_m, 0.106);
    const Eigen::Quaterniond q0(from.linear()), q1(to.linear());
    for (int i = 0; i <= 500; ++i) {
      const double share = i / 500.0;
      const Eigen::Vector3d truth =
          from.translation() + share * (to.translation() - from.translation()) + q0.slerp(share, q1) * point;
      const auto next = std::find_if(knots.begin() + 1, knots.end() - 1, [&](const auto& k) { return k.at >= share; });
      const SphereKnot &a = *(next - 1), &b = *next;
      const Eigen::Vector3d p = a.center_m + (share - a.at) / (b.at - a.at) * (b.center_m - a.center_m);
      EXPECT_LE((truth - p).norm() + 0.1, a.radius_m + 1e-9);
    }
  }
}

TrajectoryQuery TrajectoryQueryOf(Map& map, TrajectoryOptions options) {
  auto query = TrajectoryQuery::Make(SurfacesOf(map), std::move(options));
  EXPECT_TRUE(query.ok());
  return std::move(*query);
}

Transform At(double x, double y, double z, double turn_rad = 0) {
  Transform T = Transform::Identity();
  T.translate(Eigen::Vector3d(x, y, z));
  T.rotate(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()));
  return T;
}

TEST(TrajectoryQuery, AnArmThatTurnsMeetsThePillarBetweenItsWaypoints) {
  Map map(testing::SceneInfo());
  const double angle_rad = 0.9;
  const Eigen::Vector3d pillar(1.2 * std::cos(angle_rad), 1.2 * std::sin(angle_rad), 0);
  testing::ObserveBand(testing::AddThing(map), testing::Ball(pillar, 0.1), testing::CubeAt(pillar, 0.3));
  const TrajectoryQuery query = TrajectoryQueryOf(map, {.bodies = kIgnoringUnknown});
  RobotMotion motion;
  motion.robot = {{{0, 0, 0}, 0.2}, {{1.2, 0, 0}, 0.05}};
  motion.waypoints = {At(0, 0, 0), At(0, 0, 0, M_PI / 2), At(0, 0, 0, 3)};
  const auto answer = query.Check(motion);
  ASSERT_TRUE(answer.ok());
  EXPECT_FALSE(answer->is_valid);
  ASSERT_EQ(answer->contacts.size(), 1u);
  EXPECT_EQ(answer->contacts[0].sphere, 1u);
  const double touch_rad = angle_rad - 2 * std::asin(0.15 / 2 / 1.2);
  EXPECT_NEAR(answer->contacts[0].at, touch_rad / (M_PI / 2), 0.01);
  motion.waypoints = {At(0, 0, 0), At(0, 0, 0, 0.6)};
  EXPECT_TRUE(query.Check(motion)->is_valid);
  motion.waypoints = {At(0, 0, 0, 0.9)};
  EXPECT_EQ(query.Check(motion)->contacts.at(0).at, 0) << "a single waypoint is a pose";
}

TEST(TrajectoryQuery, TheFirstIsTheEarliestOfAllPartsAndAllAreOneAPair) {
  Map map(testing::SceneInfo());
  for (const double x : {1.0, 2.0}) {
    testing::ObserveBand(testing::AddThing(map), testing::Ball({x, 0, 0}, 0.3), testing::CubeAt({x, 0, 0}, 0.5));
  }
  const auto line = [](double y) { return Knots{{0, {0, y, 0}, 0.1}, {1, {1.5, y, 0}, 0.1}, {2, {3, y, 0}, 0.1}}; };
  RobotMotion motion;
  motion.spheres = {line(0.3), line(2), line(0)};
  const auto first = TrajectoryQueryOf(map, {.bodies = kIgnoringUnknown}).Check(motion);
  ASSERT_EQ(first->contacts.size(), 1u);
  EXPECT_EQ(first->contacts[0].sphere, 2u);
  EXPECT_NEAR(first->contacts[0].at, 0.6 / 1.5, 0.01);
  EXPECT_EQ(first->contacts[0].contact.submap->id, SubmapId(1));
  const auto all = TrajectoryQueryOf(map, {.bodies = kIgnoringUnknown, .max_contacts = 10}).Check(motion);
  ASSERT_EQ(all->contacts.size(), 4u);
  EXPECT_EQ(all->contacts[0].at, first->contacts[0].at);
  EXPECT_EQ(all->contacts[3].contact.submap->id, SubmapId(2));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_LE(all->contacts[i - 1].at, all->contacts[i].at);
  EXPECT_EQ(TrajectoryQueryOf(map, {.bodies = kIgnoringUnknown, .max_contacts = 3}).Check(motion)->contacts.size(), 3u);
}

/// A cup (1) on a table (2), and a wall (3) at x = 1.
Map CupOnTable() {
  Map map(testing::SceneInfo());
  const auto cup = testing::Block({0, 0, 0.1}, {0.1, 0.1, 0.1});
  testing::ObserveBand(testing::AddThing(map), cup, testing::CubeAt({0, 0, 0.1}, 0.3),
                       [](const Eigen::Vector3d& p) { return p.z() > 0; });
  testing::ObserveBand(
      testing::AddThing(map, ClassId(2)), [](const Eigen::Vector3d& p) { return p.z(); },
      {Eigen::Vector3d(-0.5, -0.5, -0.1), Eigen::Vector3d(0.5, 0.5, 0.1)},
      [&](const Eigen::Vector3d& p) { return cup(p) > 0.05; });
  testing::ObserveBand(testing::AddThing(map, ClassId(2)), [](const Eigen::Vector3d& p) { return 1 - p.x(); },
                       {Eigen::Vector3d(0.8, -0.8, 0), Eigen::Vector3d(1.2, 0.8, 1.2)});
  return map;
}

TEST(TrajectoryQuery, AllAreThoseWhoseSurfacesItMeetsNotThoseItIsThenBehind) {
  Map map = SheetMap();
  Submap& back = testing::AddThing(map);
  testing::ObserveBand(back, [](const Eigen::Vector3d& p) { return p.x() - 0.7; },
                       {Eigen::Vector3d(0.4, -1, -1), Eigen::Vector3d(1, 1, 1)});
  const TrajectoryQuery query = TrajectoryQueryOf(map, {.bodies = kIgnoringUnknown, .max_contacts = 10});
  const auto met_up_to = [&](double x) {
    std::vector<SubmapId> ids;
    RobotMotion motion;
    motion.spheres = {Knots{{0, {-0.2, 0, 0}, 0.02}, {1, {x, 0, 0}, 0.02}}};
    const auto answer = query.Check(motion);
    for (const TrajectoryContact& contact : answer->contacts) ids.push_back(contact.contact.submap->id);
    return ids;
  };
  EXPECT_EQ(met_up_to(0.2).size(), 0u);
  EXPECT_EQ(met_up_to(0.5), std::vector{SubmapId(1)}) << "behind both sides of the wall, it has touched one";
  EXPECT_EQ(met_up_to(0.9), (std::vector{SubmapId(1), back.id()}));
}

TEST(TrajectoryQuery, WhatIsCarriedLeavesTheWorldAndMeetsWhatIsInItsWay) {
  Map map = CupOnTable();
  TrajectoryOptions options{.bodies = kIgnoringUnknown, .attached = {{SubmapId(1), {SubmapId(2)}}}};
  options.bodies.scope.attached = {SubmapId(1)};
  RobotMotion motion;  // a gripper that goes through where the cup is, lifts it and carries it to the wall
  const std::vector<Transform> poses = {At(0, 0, 0), At(0, 0, 0.5), At(1.5, 0, 0.5)};
  motion.robot = {{{0, 0, 0.1}, 0.05}};
  motion.waypoints = poses;
  motion.attached = {poses};
  const auto answer = TrajectoryQueryOf(map, options).Check(motion);
  ASSERT_TRUE(answer.ok());
  ASSERT_EQ(answer->contacts.size(), 1u);
  const TrajectoryContact& wall = answer->contacts[0];
  EXPECT_EQ(wall.attached, 0u);
  EXPECT_EQ(wall.contact.submap->id, SubmapId(3));
  EXPECT_NEAR(wall.at, 1 + 0.9 / 1.5, kSceneVoxel_m / 1.5) << "sooner by no more than half a voxel's diagonal";
  EXPECT_LE(wall.at, 1 + 0.9 / 1.5 + 1e-3);
  motion.waypoints.pop_back();
  motion.attached[0].pop_back();
  EXPECT_TRUE(TrajectoryQueryOf(map, options).Check(motion)->is_valid);
  options.attached[0].may_touch.clear();
  motion.attached[0][0] = At(0.3, 0, -0.1);  // set down too low: where it stood nobody has seen that they touch
  const auto table = TrajectoryQueryOf(map, options).Check(motion);
  ASSERT_EQ(table->contacts.size(), 1u);
  EXPECT_EQ(table->contacts[0].at, 0);
  EXPECT_EQ(table->contacts[0].contact.submap->id, SubmapId(2));
  options.attached.clear();
  options.bodies.scope.attached.clear();
  motion.attached.clear();
  EXPECT_EQ(TrajectoryQueryOf(map, options).Check(motion)->contacts.at(0).contact.submap->id, SubmapId(1))
      << "it stands there";
}

TEST(AttachedShapeOf, HoldsTheSurfaceAndSticksOutByHalfAVoxelsDiagonalAtMost) {
  Map map = testing::FurnishedRoom();
  map.FindMutable(SubmapId(2))->mutable_info().T_map_submap = At(3, 1, 0, 1);
  const auto surfaces = SurfacesOf(map);
  for (const std::size_t number : {1u, 2u}) {
    const Submap& submap = surfaces->index().entries()[number].submap();
    const AttachedShape body = AttachedShapeOf(surfaces->state(), submap, surfaces->surface(number), 100'000);
    const Transform T_submap_map = submap.info().T_map_submap.inverse();
    std::vector<AttachedShape::Ball> balls;
    for (const AttachedShape::Group& group : body.groups) {
      for (const AttachedShape::Ball& ball : group.balls) {
        balls.push_back(ball);
        EXPECT_LE(ball.radius_m, 0.5 * std::sqrt(3) * kSceneVoxel_m + 1e-6);
        EXPECT_LE((ball.center_m - group.around.center_m).norm() + ball.radius_m, group.around.radius_m + 1e-9);
        EXPECT_LE(ball.center_m.norm() + ball.radius_m, body.reach_m + 1e-9);
      }
    }
    EXPECT_EQ(balls.size(), body.num_balls);
    for (const auto& t : testing::TrianglesInMap(submap)) {
      const Eigen::Vector3d p = T_submap_map * ((t[0] + t[1] + t[2]) / 3);
      EXPECT_TRUE(std::any_of(balls.begin(), balls.end(), [&](const AttachedShape::Ball& ball) {
        return (p - ball.center_m).norm() <= ball.radius_m + 1e-6;
      }));
    }
  }
  EXPECT_GT(WholeBodyOf(*surfaces, SubmapId(1), 10).num_balls, 10u)
      << "no more than it takes to see that it is too large";
}

TEST(WholeBodyOf, IsAllOfWhatARobotCarriesThoughItsPlaceWasLookedThrough) {
  // What is taken from its place is contradicted there, and soon absent; in the gripper it is as large as ever.
  Map map = testing::FurnishedRoom();
  const auto before = SurfacesOf(map);
  const AttachedShape whole = WholeBodyOf(*before, SubmapId(2), 100'000);
  ASSERT_GT(whole.num_balls, 100u);
  Submap& carried = *map.FindMutable(SubmapId(2));
  std::vector<BlockIndex> blocks;
  for (const BlockEntry& block : carried.blocks().entries()) blocks.push_back(block.index);
  for (const BlockIndex block : blocks) {
    for (int i = 0; i < kBlockVoxels; ++i) carried.MutableGone(block).Set(i, GoneBlock::kContradicted);
  }
  const auto expect_whole = [&](const AttachedShape& body) {
    EXPECT_EQ(body.num_balls, whole.num_balls);
    EXPECT_EQ(body.groups.size(), whole.groups.size());
    EXPECT_EQ(body.reach_m, whole.reach_m);
  };
  const auto gone = SurfacesOf(map);
  expect_whole(WholeBodyOf(*gone, SubmapId(2), 100'000));
  map.FindMutable(SubmapId(2))->mutable_info().presence = Presence::kAbsent;
  const auto absent = SurfacesOf(map);
  expect_whole(WholeBodyOf(*absent, SubmapId(2), 100'000));
  EXPECT_EQ(WholeBodyOf(*absent, SubmapId(99), 100'000).num_balls, 0u);
  // The state itself is as it was.
  EXPECT_NE(absent->state().Find(SubmapId(2))->blocks().Find(blocks.front())->gone, nullptr);
}

TEST(TrajectoryQuery, EndsSoonAfterTheCallerIsGoneAndRefusesWhatIsTooLarge) {
  Map map = CupOnTable();
  RobotMotion motion;
  motion.spheres = {Knots{{0, {0, 0, 1}, 0.1}}};
  std::stop_source caller;
  caller.request_stop();
  EXPECT_EQ(TrajectoryQueryOf(map, {}).Check(motion, caller.get_token()).status().code(), StatusCode::kCancelled);
  EXPECT_TRUE(TrajectoryQueryOf(map, {}).Check(RobotMotion{})->is_valid) << "nothing meets nothing";
}

}  // namespace
}  // namespace dhpmap

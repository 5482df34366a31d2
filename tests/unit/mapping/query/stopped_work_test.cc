// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/mapping/query/stopped_work.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/query/relations.h"
#include "mapping/query/submap_search.h"
#include "mapping/query/trajectory_query.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

constexpr std::size_t kNoLimit = std::size_t{1} << 30;

/// One object of two million voxels, made once for all tests.
const std::shared_ptr<const MapSnapshot>& LargeThing() {
  static const auto map = testing::SheetMap(1, 1, 45);
  return map;
}

TEST(SearchSubmapsClock, StopsWhileTheSurfaceOfALargeObjectIsMade) {
  testing::ExpectEndsSoonAfterAStop([](const std::stop_token& stop) {
    SurfaceCache cache(kNoLimit);
    const auto surfaces = cache.Of(LargeThing());
    const auto matches = SearchSubmaps(*surfaces, {}, stop);
    EXPECT_TRUE(stop.stop_requested() || (matches.size() == 1 && !matches[0].box_m.isEmpty()));
    return stop.stop_requested();
  });
}

TEST(SearchSubmapsClock, StopsWhileALargeObjectIsLookedForInABox) {
  SubmapQuestion question;
  question.box_m.emplace(Eigen::Vector3d(0, 0, 0.25), Eigen::Vector3d(50, 50, 0.35));  // above all of the sheet
  testing::ExpectEndsSoonAfterAStop([&](const std::stop_token& stop) {
    SurfaceCache cache(kNoLimit);
    EXPECT_TRUE(SearchSubmaps(*cache.Of(LargeThing()), question, stop).empty());
    return stop.stop_requested();
  });
}

TEST(FindRelationsClock, StopsWhileTheSurfaceOfALargeObjectIsMade) {
  testing::ExpectEndsSoonAfterAStop([](const std::stop_token& stop) {
    SurfaceCache cache(kNoLimit);
    EXPECT_TRUE(FindRelations(*cache.Of(LargeThing()), {}, stop).empty()) << "it is alone";
    return stop.stop_requested();
  });
}

/// A ball in the middle of a hollow one.
Map BallInABall() {
  Map map(testing::SceneInfo());
  const auto hollow = [ball = testing::Ball({0, 0, 0}, 1.5)](const Eigen::Vector3d& p) { return -ball(p); };
  testing::ObserveBand(testing::AddThing(map), testing::Ball({0, 0, 0}, 0.7), testing::CubeAt({0, 0, 0}, 0.9));
  testing::ObserveBand(testing::AddThing(map), hollow, testing::CubeAt({0, 0, 0}, 1.7));
  return map;
}

TEST(FindRelationsClock, StopsBetweenThePointsOfTwoObjectsAndTellsNothingByHalves) {
  Map map = BallInABall();
  SurfaceCache cache(kNoLimit);
  const auto surfaces = cache.Of(map.Publish(0));
  ASSERT_EQ(FindRelations(*surfaces, {}).size(), 1u);  // and their surfaces are there from now on
  testing::ExpectEndsSoonAfterAStop([&](const std::stop_token& stop) {
    const std::vector<Relation> found = FindRelations(*surfaces, {}, stop);
    for (const Relation& relation : found) {
      EXPECT_EQ(relation.kind, RelationKind::kIn);
      EXPECT_EQ(relation.subject->id(), SubmapId(1));
      EXPECT_NEAR(relation.gap_m, 0.8, 0.02);
    }
    return found.empty();
  });
}

bool WasCancelled(const Result<TrajectoryAnswer>& answer) {
  if (answer.ok()) {
    EXPECT_TRUE(answer->is_valid);
    return false;
  }
  EXPECT_EQ(answer.status().code(), StatusCode::kCancelled);
  return true;
}

TEST(TrajectoryQueryClock, StopsBetweenTheSpheresOfOneMotion) {
  SurfaceCache cache(kNoLimit);
  const auto query =
      TrajectoryQuery::Make(cache.Of(LargeThing()), {.bodies = {.unknown = UnknownSpace::kFree}, .attached = {}});
  ASSERT_TRUE(query.ok());
  RobotMotion motion;
  constexpr int kSide = 200;
  motion.spheres.reserve(std::size_t{kSide} * kSide);
  for (int i = 0; i < kSide * kSide; ++i) {
    const double x_m = 2 + 0.05 * (i % kSide), y_m = 2 + 0.05 * (i / kSide);
    motion.spheres.push_back(std::vector<SphereKnot>{{0, {x_m, y_m, 0.25}, 0.02}, {1, {x_m + 0.3, y_m, 0.25}, 0.02}});
  }
  ASSERT_TRUE(query->Check(motion)->is_valid);  // and the surfaces are there from now on
  testing::ExpectEndsSoonAfterAStop(
      [&](const std::stop_token& stop) { return WasCancelled(query->Check(motion, stop)); });
}

TEST(TrajectoryQueryClock, StopsBetweenTheWaypointsOfOneSphere) {
  SurfaceCache cache(kNoLimit);
  const auto query =
      TrajectoryQuery::Make(cache.Of(LargeThing()), {.bodies = {.unknown = UnknownSpace::kFree}, .attached = {}});
  ASSERT_TRUE(query.ok());
  RobotMotion motion;
  std::vector<SphereKnot>& knots = motion.spheres.emplace_back();
  constexpr int kMostWaypoints = 10'000;
  knots.reserve(kMostWaypoints);
  for (int h = 0; h < kMostWaypoints; ++h) {
    knots.push_back({static_cast<double>(h), {h % 2 == 0 ? 5.0 : 8.0, 2 + 0.001 * h, 0.25}, 0.02});
  }
  ASSERT_TRUE(query->Check(motion)->is_valid);
  testing::ExpectEndsSoonAfterAStop(
      [&](const std::stop_token& stop) { return WasCancelled(query->Check(motion, stop)); });
}

/// A level sheet at `height_m`, in blocks of one level or two.
std::shared_ptr<const Submap> LevelSheet(std::uint32_t id, double height_m, BlockIndex low, BlockIndex high) {
  Submap sheet = testing::SolidSubmap([height_m](const Eigen::Vector3d& p) { return p.z() - height_m; }, low, high);
  sheet.mutable_info().id = SubmapId(id);
  sheet.UpdateBoundingSphere();
  return std::make_shared<const Submap>(std::move(sheet));
}

TEST(TrajectoryQueryClock, StopsBetweenTheVoxelsOfWhatIsCarried) {
  // Near enough for each of its blocks to be looked at by voxels, which touch nothing.
  const auto map = std::make_shared<const MapSnapshot>(
      LargeThing()->info(), std::vector<std::shared_ptr<const Submap>>{LevelSheet(1, 0.2, {0, 0, 0}, {19, 19, 0}),
                                                                       LevelSheet(2, 0, {-2, -2, -1}, {21, 21, 0})});
  TrajectoryOptions options{.bodies = {.unknown = UnknownSpace::kFree}, .attached = {{SubmapId(1), {}}}};
  options.bodies.scope.attached = {SubmapId(1)};
  SurfaceCache cache(kNoLimit);
  const auto query = TrajectoryQuery::Make(cache.Of(map), options);
  ASSERT_TRUE(query.ok());
  RobotMotion motion;
  motion.attached.push_back({Transform::Identity(), Transform(Eigen::Translation3d(0.2, 0, 0))});
  ASSERT_TRUE(query->Check(motion)->is_valid);
  testing::ExpectEndsSoonAfterAStop(
      [&](const std::stop_token& stop) { return WasCancelled(query->Check(motion, stop)); });
}

TEST(TrajectoryQuery, WhatIsCarriedIsNotLookedAtForSomebodyWhoIsGone) {
  TrajectoryOptions options{.bodies = {}, .attached = {{SubmapId(1), {}}}};
  options.bodies.scope.attached = {SubmapId(1)};
  SurfaceCache cache(kNoLimit);
  std::stop_source caller;
  caller.request_stop();
  const auto query = TrajectoryQuery::Make(cache.Of(LargeThing()), options, caller.get_token());
  EXPECT_EQ(query.status().code(), StatusCode::kCancelled);
  EXPECT_EQ(cache.bytes(), 0u) << "no surface was made";
}

}  // namespace
}  // namespace dhpmap

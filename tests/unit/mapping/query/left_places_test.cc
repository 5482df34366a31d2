// SPDX-License-Identifier: BSD-3-Clause
// What things leave that are left out of the world, or attached to a robot.
#include <gtest/gtest.h>

#include "mapping/query/ray_query.h"
#include "mapping/query/trajectory_query.h"
#include "mapping/query/voxel_states.h"
#include "tests/unit/mapping/query/scene_surfaces.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::kSceneTruncation_m;
using testing::kSceneVoxel_m;
using testing::SurfacesOf;

constexpr double kCup_m = 0.4;
const Eigen::Vector3d kCupAt(0.01, 0.02, -0.03);

/// A cup (thing 1 of class 1), of which nobody has seen the inside, and far away another thing.
Map CupAlone(Panoptic panoptic = Panoptic::kThing) {
  Map map(testing::SceneInfo());
  Submap& cup = testing::AddThing(map);
  cup.mutable_info().panoptic = panoptic;
  testing::ObserveBand(cup, testing::Ball(kCupAt, kCup_m), testing::CubeAt(kCupAt, 0.6));
  testing::ObserveBand(testing::AddThing(map, ClassId(2)), testing::Ball({3, 0, 0}, 0.3),
                       testing::CubeAt({3, 0, 0}, 0.5));
  return map;
}

/// Ways to leave the cup out.
std::vector<QueryScope> WithoutTheCup() {
  std::vector<QueryScope> scopes(4);
  scopes[0].excluded_submaps = {SubmapId(1)};
  scopes[1].excluded_classes = {ClassId(1)};
  scopes[2].classes = {ClassId(2)};
  scopes[3].attached = {SubmapId(1)};
  return scopes;
}

TEST(LeftPlaces, AGripperIsNotBlockedByTheInsideOfACupThatLeavesFreeSpace) {
  Map map = CupAlone();
  const auto surfaces = SurfacesOf(map);
  const Body gripper = Capsule{kCupAt, kCupAt + Eigen::Vector3d(0.1, 0, 0), 0.2};
  for (QueryScope scope : WithoutTheCup()) {
    const bool is_attached = !scope.attached.empty();
    const auto is_blocked = [&] {
      const BodyAnswer answer = BodyQuery(surfaces, {.scope = scope}).Check(gripper);
      EXPECT_EQ(answer.is_unknown, answer.is_colliding) << "there is nothing but space that nobody has seen";
      RobotMotion motion;
      motion.spheres = {{{0, kCupAt, 0.2}, {1, kCupAt + Eigen::Vector3d(0.1, 0, 0), 0.2}}};
      const auto query = TrajectoryQuery::Make(surfaces, {.bodies = {.scope = scope}, .attached = {}});
      EXPECT_EQ(query->Check(motion)->is_valid, !answer.is_colliding);
      return answer.is_colliding;
    };
    EXPECT_EQ(is_blocked(), !is_attached) << "what is attached leaves free space unless asked otherwise";
    scope.vacated_is_free = true;
    EXPECT_FALSE(is_blocked());
    scope.vacated_is_free = false;
    scope.keeps_attached_unknown = true;
    EXPECT_TRUE(is_blocked());
  }
}

TEST(LeftPlaces, AreWhereItWasAndItsInsideAndNothingElseInAllAnswers) {
  Map map = CupAlone();
  const auto surfaces = SurfacesOf(map);
  for (QueryScope scope : WithoutTheCup()) {
    scope.vacated_is_free = true;
    const QueryWorld world(surfaces, scope);
    VoxelStates states(surfaces, {.scope = scope}, false);
    const DistanceQuery distances(surfaces, {.max_distance_m = 5, .scope = scope});
    int num_left = 0, num_unknown = 0;
    for (int z = -14; z < 14; ++z) {
      for (int y = -14; y < 14; ++y) {
        for (int x = -14; x < 14; ++x) {
          const Eigen::Vector3d p = VoxelCentre({x, y, z}, kSceneVoxel_m);
          const double d = (p - kCupAt).norm() - kCup_m;
          if (std::abs(d - kSceneTruncation_m) < 1e-3) continue;
          const bool is_left = d < kSceneTruncation_m;
          EXPECT_EQ(world.IsSeen({x, y, z}), is_left) << p.transpose();
          EXPECT_EQ(states.At(p).state, is_left ? VoxelState::kFree : VoxelState::kUnknown) << p.transpose();
          EXPECT_EQ(distances.At(p).status, is_left ? DistanceStatus::kOk : DistanceStatus::kUnknown);
          ++(is_left ? num_left : num_unknown);
        }
      }
    }
    EXPECT_GT(num_left, 3000);
    EXPECT_GT(num_unknown, 3000);
    const RayHit hit = RayQuery(surfaces, {.max_distance_m = 2, .scope = scope}).Cast({kCupAt, {0, 1, 0}});
    EXPECT_NEAR(hit.free_m, kCup_m + kSceneTruncation_m, kSceneVoxel_m);
  }
}

TEST(LeftPlaces, OfBackgroundAreOnlyWhereItWasSeen) {
  Map map = CupAlone(Panoptic::kStuff);  // has no inside
  QueryScope scope = WithoutTheCup()[0];
  scope.vacated_is_free = true;
  const QueryWorld world(SurfacesOf(map), scope);
  EXPECT_TRUE(world.IsLeft(kCupAt + Eigen::Vector3d(kCup_m, 0, 0)));
  EXPECT_FALSE(world.IsLeft(kCupAt));
}

TEST(LeftPlaces, WhatIsSeenThereOfOthersIsThere) {
  Map map = CupAlone();
  testing::ObserveBand(testing::AddThing(map, ClassId(2)), testing::Ball(kCupAt, 0.1), testing::CubeAt(kCupAt, 0.2));
  QueryScope scope = WithoutTheCup()[0];
  scope.vacated_is_free = true;
  const auto surfaces = SurfacesOf(map);
  const BodyAnswer answer = BodyQuery(surfaces, {.scope = scope}).Check(Capsule{kCupAt, kCupAt, 0.15});
  ASSERT_EQ(answer.contacts.size(), 1u);
  EXPECT_EQ(answer.contacts[0].submap->id, SubmapId(3));
  EXPECT_EQ(VoxelStates(surfaces, {.scope = scope}, false).At(kCupAt + Eigen::Vector3d(0.05, 0, 0)).state,
            VoxelState::kInside);
}

}  // namespace
}  // namespace dhpmap

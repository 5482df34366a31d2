// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "server/app/queries/body_check.h"
#include "server/app/queries/distance_lookup.h"
#include "server/app/queries/ray_cast.h"
#include "server/app/queries/slice_export.h"
#include "server/app/queries/trajectory_check.h"
#include "tests/unit/mapping/query/surface_scene.h"

// Absent objects do not count in queries, unless the query includes them.

namespace dhpmap {
namespace {

/// An absent ball, and a present one 3 m away.
class AbsentObjects : public ::testing::TestWithParam<bool> {
 protected:
  AbsentObjects() {
    Submap& absent = testing::AddThing(map_);
    testing::ObserveBand(absent, testing::Ball({0, 0, 0}, 0.5), testing::CubeAt({0, 0, 0}, 0.7));
    absent.mutable_info().presence = Presence::kAbsent;
    testing::ObserveBand(testing::AddThing(map_), testing::Ball({3, 0, 0}, 0.5), testing::CubeAt({3, 0, 0}, 0.7));
    view_ = std::make_shared<const MapView>(map_.Publish(0));
    scope_.with_absent = GetParam();
  }
  [[nodiscard]] SubmapId Nearest() const { return SubmapId(GetParam() ? 1 : 2); }

  Map map_{testing::SceneInfo()};
  std::shared_ptr<const MapView> view_;
  SurfaceCache cache_{std::size_t{1} << 28};
  QueryScope scope_;
};

TEST_P(AbsentObjects, OfDistancesAndRays) {
  DistanceQuestion question;
  question.options.scope = scope_;
  const std::vector<Eigen::Vector3d> points_m = {{0.8, 0, 0}};
  ASSERT_TRUE(LookUpDistances(*view_, cache_, question, points_m, {}, InPlace, [&](const SurfaceDistance& answer) {
                EXPECT_EQ(answer.submap->id, Nearest());
                EXPECT_NEAR(answer.distance_m, GetParam() ? 0.3 : 1.7, 0.01);
              }).ok());
  const std::vector<Ray> rays = {{{-0.8, 0, 0}, Eigen::Vector3d::UnitX()}};
  question.options.max_distance_m = 5;
  ASSERT_TRUE(CastRays(*view_, cache_, question, rays, {}, [&](const RayHit& hit) {
                EXPECT_EQ(hit.submap->id, Nearest());
                EXPECT_NEAR(hit.distance_m, GetParam() ? 0.3 : 3.3, 0.01);
              }).ok());
}

TEST_P(AbsentObjects, OfBodiesAndMotions) {
  CheckQuestion question;
  question.options.scope = scope_;
  question.options.unknown = UnknownSpace::kFree;
  const std::vector<Body> bodies = {Capsule{{0.5, 0, 0}, {0.5, 0, 0}, 0.1}, Capsule{{2.5, 0, 0}, {2.5, 0, 0}, 0.1}};
  std::vector<bool> colliding;
  ASSERT_TRUE(CheckBodies(*view_, cache_, question, bodies, {}, [&](const BodyAnswer& answer) {
                colliding.push_back(answer.is_colliding);
              }).ok());
  EXPECT_EQ(colliding, (std::vector<bool>{GetParam(), true}));
  const auto motion_of = [](std::size_t) {
    RobotMotion motion;
    motion.spheres.resize(1);
    motion.spheres[0] = {{.at = 0, .center_m = {0, -2, 0}, .radius_m = 0.1},
                         {.at = 1, .center_m = {0, 2, 0}, .radius_m = 0.1}};
    return motion;
  };
  ASSERT_TRUE(CheckTrajectories(*view_, cache_, question, 1, motion_of, {}, [&](const TrajectoryAnswer& answer) {
                EXPECT_EQ(answer.is_valid, !GetParam());
              }).ok());
}

TEST_P(AbsentObjects, OfSlices) {
  SliceRequest request;
  request.options.scope = scope_;
  request.options.min_z_m = 0;
  request.options.max_z_m = 0.05;
  request.options.resolution_m = 0.05;
  request.area_m = Eigen::AlignedBox2d(Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1));
  const Result<SliceAnswer> slice = ExportSlice(*view_, cache_, request, {});
  ASSERT_TRUE(slice.ok());
  int num_occupied = 0;
  for (const std::int8_t cell : slice->cells) num_occupied += cell == kOccupiedCell;
  EXPECT_EQ(num_occupied > 0, GetParam());
}

INSTANTIATE_TEST_SUITE_P(WithAndWithout, AbsentObjects, ::testing::Bool(),
                         [](const auto& each) { return each.param ? "AskedFor" : "LeftOut"; });

}  // namespace
}  // namespace dhpmap

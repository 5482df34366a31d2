// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/map_fit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/mapping/plausibility/walked_room.h"

namespace dhpmap {
namespace {

using testing::EmptyMap;
using testing::WalkFrame;
using testing::WalkPose;

/// A wall 2 m before the camera, seen straight on from the origin along x.
class WallFit : public ::testing::Test {
 protected:
  static constexpr float kWall_m = 2;

  WallFit() : builder_(EmptyMap(), 1) {
    const testing::Scene wall{
        {{.shape = testing::Solid::Shape::kHalfSpace, .center_m = {kWall_m, 0, 0}, .size_m = {-1, 0, 0}}}};
    PanopticFrame frame = Render(wall, testing::SmallCamera(), T_map_sensor_);
    frame.camera->segments.clear();
    EXPECT_TRUE(builder_.Integrate(frame).ok());
  }

  /// Of points that are all so far ahead.
  [[nodiscard]] MapFit FitAt(float depth_m) const {
    std::vector<Eigen::Vector3f> points_m;
    for (int y = -10; y <= 10; ++y)
      for (int x = -10; x <= 10; ++x) points_m.emplace_back(0.047f * x, 0.053f * y, depth_m);
    return FitToMap(points_m, T_map_sensor_, builder_.map());
  }

  const Transform T_map_sensor_ = testing::LookAt({0, 0, 0}, {1, 0, 0});
  MapBuilder builder_;
};

TEST_F(WallFit, PointsOnASurfaceAgreeAndTheirDistanceToItIsTold) {
  for (const float off_m : {0.0f, 0.013f, -0.017f, 0.03f, -0.04f}) {
    const MapFit fit = FitAt(kWall_m + off_m);
    EXPECT_EQ(fit.num_points, 441u);
    EXPECT_EQ(fit.num_agreeing, fit.num_points) << off_m;
    ASSERT_EQ(fit.residuals_m.size(), fit.num_points);
    for (const float residual_m : fit.residuals_m) EXPECT_NEAR(residual_m, std::abs(off_m), 2e-3) << off_m;
  }
}

TEST_F(WallFit, PointsInFrontOfASurfaceAreContradictedWhereSomebodyLookedThere) {
  for (const float off_m : {0.07f, 0.1f, 0.3f, 1.0f}) {
    const MapFit fit = FitAt(kWall_m - off_m);
    EXPECT_EQ(fit.num_contradicted, fit.num_points) << off_m;
    EXPECT_EQ(fit.AgreeingFraction(), 0) << off_m;
    EXPECT_EQ(fit.KnownFraction(), 1) << off_m;
  }
}

TEST_F(WallFit, OfPointsBehindASurfaceNothingIsKnown) {
  const MapFit fit = FitAt(kWall_m + 0.2f);
  EXPECT_EQ(fit.num_known(), 0u);
  EXPECT_EQ(fit.KnownFraction(), 0);
  EXPECT_TRUE(fit.residuals_m.empty());
}

TEST_F(WallFit, RaysThatASurfaceShouldHaveStoppedAreCounted) {
  const auto through = [this](float depth_m) {
    std::vector<Eigen::Vector3f> points_m;
    for (int y = -10; y <= 10; ++y)
      for (int x = -10; x <= 10; ++x) points_m.emplace_back(0.047f * x * depth_m, 0.053f * y * depth_m, depth_m);
    return SeenThroughFraction(points_m, T_map_sensor_, builder_.map());
  };
  EXPECT_EQ(through(1), 0) << "before it";
  EXPECT_EQ(through(kWall_m), 0) << "on it";
  EXPECT_GT(through(kWall_m + 1), 0.95) << "but for a ray or two between voxels";
  EXPECT_EQ(SeenThroughFraction({}, T_map_sensor_, builder_.map()), 0);
}

TEST_F(WallFit, BeyondTheGridNothingIsKnown) {
  Transform T_far = T_map_sensor_;
  T_far.translation().x() = 1e12;
  const std::vector<Eigen::Vector3f> points_m(50, {0, 0, 1});
  EXPECT_EQ(FitToMap(points_m, T_far, builder_.map()).num_known(), 0u);
}

TEST_F(WallFit, ASurfaceThatSomebodyHasMovedIsWhereItWasPut) {
  Submap& wall = *builder_.map().FindMutable(kUnknownSubmap);
  wall.mutable_info().T_map_submap.translation().x() = 0.5;
  EXPECT_EQ(FitAt(kWall_m + 0.5f).num_agreeing, 441u);
  const MapFit before = FitAt(kWall_m);
  EXPECT_EQ(before.num_agreeing, 0u);
  EXPECT_EQ(before.residuals_m.size(), 0u);
}

TEST(MapFit, AFrameAgreesWithTheMapMadeOfItWithinAFractionOfAVoxel) {
  MapBuilder builder(EmptyMap(), 1);
  const PanopticFrame frame = WalkFrame(0);
  ASSERT_TRUE(builder.Integrate(frame).ok());
  std::vector<Eigen::Vector3f> points_m;
  const PinholeCamera& camera = frame.camera->camera;
  for (int v = 3; v < camera.height_px; v += 11) {
    for (int u = 3; u < camera.width_px; u += 11) {
      const float depth_m = frame.camera->depth_m[static_cast<std::size_t>(v * camera.width_px + u)];
      const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
      if (depth_m * ray.norm() < 4.9) points_m.push_back(depth_m * ray.cast<float>());
    }
  }
  MapFit fit = FitToMap(points_m, WalkPose(0), builder.map());
  EXPECT_EQ(fit.num_agreeing, fit.num_points);
  std::sort(fit.residuals_m.begin(), fit.residuals_m.end());
  EXPECT_LT(fit.residuals_m[fit.residuals_m.size() / 2], 0.004);
}

}  // namespace
}  // namespace dhpmap

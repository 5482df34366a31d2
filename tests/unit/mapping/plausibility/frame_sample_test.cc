// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/frame_sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/mapping/plausibility/mistakes.h"
#include "tests/unit/mapping/plausibility/walked_room.h"

namespace dhpmap {
namespace {

PanopticFrame FlatFrame(int width_px, int height_px, float depth_m) {
  PanopticFrame frame;
  frame.camera = DepthCameraData{.camera = {.width_px = width_px,
                                            .height_px = height_px,
                                            .fx_px = 0.5 * width_px,
                                            .fy_px = 0.5 * width_px,
                                            .cx_px = 0.5 * width_px,
                                            .cy_px = 0.5 * height_px}};
  frame.camera->depth_m.assign(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), depth_m);
  return frame;
}

TEST(FrameSample, HasSomeHundredPointsOfAnImageOfAnySize) {
  for (const auto& [width_px, height_px] : {std::pair{64, 48}, {640, 480}, {1280, 1024}, {3000, 200}}) {
    const FrameSample sample(FlatFrame(width_px, height_px, 2));
    EXPECT_GE(sample.num_returns(), 200u) << width_px;
    EXPECT_LE(sample.num_returns(), 450u) << width_px;
  }
  EXPECT_EQ(FrameSample(FlatFrame(1, 1, 2)).num_returns(), 1u);
  PanopticFrame scan;
  scan.lidar = LidarData{.points_m = std::vector<Eigen::Vector3f>(120'001, {3, 0, 0})};
  EXPECT_GE(FrameSample(scan).num_returns(), 250u);
  EXPECT_LE(FrameSample(scan).num_returns(), 300u);
  scan.lidar->points_m.clear();
  EXPECT_EQ(FrameSample(scan).num_returns(), 0u);
}

TEST(FrameSample, PixelsWithoutAReturnAreNone) {
  for (const float depth_m :
       {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(FrameSample(FlatFrame(64, 48, depth_m)).num_returns(), 0u) << depth_m;
  }
}

TEST(FrameSample, PointsAreThoseOfTheCameraThatIsClaimed) {
  const PanopticFrame frame = testing::WalkFrame(0);
  const FrameSample sample(frame);
  const SensorClaim claim = SensorClaim::Of(frame);
  const IntegrationConfig config;
  const auto points_m = sample.PointsInRange(claim, config);
  const testing::Scene room = testing::FurnishedRoom();
  ASSERT_GT(points_m.size(), 100u);
  for (const Eigen::Vector3f& p : points_m) {
    EXPECT_NEAR(room.Distance(frame.T_map_sensor * p.cast<double>()), 0, 1e-3);
    EXPECT_LE(p.norm(), config.max_range_m);
    EXPECT_GE(p.norm(), config.min_range_m);
  }
  EXPECT_LT(points_m.size(), sample.num_returns()) << "some are out of range";
}

TEST(Corrected, UndoesTheMistake) {
  for (const testing::Mistake& mistake : testing::MistakesOfDepthCameras()) {
    const PanopticFrame frame = testing::WalkFrame(3);
    PanopticFrame wrong = frame;
    mistake.make(wrong);
    const SensorClaim right = Corrected(SensorClaim::Of(wrong), mistake.fault);
    EXPECT_TRUE(IsIdentity(right.T_map_sensor.inverse() * frame.T_map_sensor, 1e-9)) << FaultName(mistake.fault);
    EXPECT_EQ(right.camera->fx_px, frame.camera->camera.fx_px);
    EXPECT_NEAR(right.camera->cy_px, frame.camera->camera.cy_px, 0.5) << "where the corner of a pixel lies is custom";
    const float depth_m = frame.camera->depth_m.front();
    EXPECT_NEAR(wrong.camera->depth_m.front() * right.metres_per_unit, depth_m, 1e-5);
  }
}

}  // namespace
}  // namespace dhpmap

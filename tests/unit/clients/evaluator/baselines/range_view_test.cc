// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/range_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mapping/map/map_config.h"

namespace dhpmap::evaluator {
namespace {

/// 4 x 3 pixels with 1 px of focal length; what is behind pixel (u, v) lies at (u - 1, v - 1, 1) * depth.
PanopticFrame SmallFrame() {
  PanopticFrame frame;
  frame.segments = {{.id = SegmentId(40), .class_id = ClassId(1)}, {.id = SegmentId(50), .class_id = ClassId(2)}};
  frame.unlisted_ids_are_unknown = true;
  DepthCameraData& data = frame.camera.emplace();
  data.camera = {4, 3, 1.0, 1.0, 1.0, 1.0};
  data.depth_m = {2, 2, 2, 2, 2, 2, 3, 3, 2, 2, 0, 9};
  data.segments = {40, 40, 40, 40, 40, 40, 50, 50, 40, 40, 50, 99};
  return frame;
}

IntegrationConfig UpTo(double max_range_m) {
  IntegrationConfig config;
  config.max_range_m = max_range_m;
  return config;
}

TEST(RangeViewTest, ReadsRangesAlongTheRay) {
  const RangeView view(SmallFrame(), UpTo(20));
  RangeReading reading;
  ASSERT_TRUE(view.Read({0, 0, 0.5f}, reading));  // pixel (1, 1), whose neighbour to the right is farther
  EXPECT_FLOAT_EQ(reading.range_m, 2.0f);
  EXPECT_EQ(reading.row, 0);
  ASSERT_TRUE(view.Read({1, 0, 1}, reading));  // pixel (2, 1)
  EXPECT_FLOAT_EQ(reading.range_m, 3.0f * std::sqrt(2.0f));
  EXPECT_EQ(reading.row, 1);
}

TEST(RangeViewTest, InterpolatesOnlyWhereNeighboursAgree) {
  PanopticFrame frame = SmallFrame();
  RangeReading reading;
  const Eigen::Vector3f between(0.5f, 0, 1);  // halfway between pixels (1, 1) and (2, 1)
  ASSERT_TRUE(RangeView(frame, UpTo(20)).Read(between, reading));
  EXPECT_FLOAT_EQ(reading.range_m, 2.0f);  // 2 and 4.24: of two surfaces, so one of them

  frame.camera->depth_m = std::vector<float>(12, 2.0f);
  frame.camera->depth_m[6] = 2.1f / std::sqrt(2.0f);
  frame.camera->depth_m[10] = 2.1f / std::sqrt(3.0f);  // below pixel (2, 1), of no say halfway between columns
  frame.camera->depth_m[9] = 2.0f / std::sqrt(2.0f);   // below pixel (1, 1)
  ASSERT_TRUE(RangeView(frame, UpTo(20)).Read(between, reading));
  EXPECT_FLOAT_EQ(reading.range_m, 2.05f);
}

TEST(RangeViewTest, KnowsNothingOutsideTheImageOrTheRangesOrWithoutReturn) {
  PanopticFrame frame = SmallFrame();
  const RangeView view(frame, UpTo(10));
  RangeReading reading;
  EXPECT_FALSE(view.Read({0, 0, -1}, reading));     // behind the camera
  EXPECT_FALSE(view.Read({-1.1f, 0, 1}, reading));  // left of the first pixel's centre
  EXPECT_FALSE(view.Read({2, 1.1f, 1}, reading));
  EXPECT_FALSE(view.Read({2, 1, 1}, reading));  // 9 m deep, 22 m away
  EXPECT_TRUE(RangeView(frame, UpTo(30)).Read({2, 1, 1}, reading));
  EXPECT_EQ(reading.row, -1);  // segment 99 has no row
}

TEST(RangeViewTest, WeightCountsRaysAndTheirNoise) {
  PanopticFrame frame = SmallFrame();
  IntegrationConfig config = UpTo(20);
  config.weighting = Weighting::kInverseDepthSquared;
  // (0.04 m / 2 m)^2 pixels of focal length 1, each weighing 1 / (2 m)^2.
  EXPECT_FLOAT_EQ(RangeView(frame, config).Weight({0.3f, 0, 2}, 0.04f), 0.0004f / 4);
  config.weighting = Weighting::kConstant;
  EXPECT_FLOAT_EQ(RangeView(frame, config).Weight({0.3f, 0, 2}, 0.04f), 0.0004f);
}

TEST(RangeViewTest, TheNearestPointOfAScanWinsItsPixel) {
  PanopticFrame frame;
  frame.segments = {{.id = SegmentId(1), .class_id = ClassId(1)}, {.id = SegmentId(2), .class_id = ClassId(2)}};
  frame.lidar = {.points_m = {{8, 0, 0}, {4, 0, 0}, {6, 0, 0}, {0, 5, 0}, {-3, -0.001f, 0}, {2, 0, 2}},
                 .color = {},
                 .segments = {1, 2, 1, 1, 2, 1}};
  const RangeView view(frame, UpTo(20));
  RangeReading reading;
  ASSERT_TRUE(view.Read({1, 0, 0}, reading));
  EXPECT_FLOAT_EQ(reading.range_m, 4.0f);
  EXPECT_EQ(reading.row, 1);
  ASSERT_TRUE(view.Read({0, 7, 0}, reading));
  EXPECT_FLOAT_EQ(reading.range_m, 5.0f);
  ASSERT_TRUE(view.Read({-7, 0.001f, 0}, reading));  // across the seam behind the scanner
  EXPECT_NEAR(reading.range_m, 3.0f, 1e-5);
  EXPECT_FALSE(view.Read({0, -1, 0}, reading));  // nothing there
  EXPECT_FALSE(view.Read({1, 0, 1}, reading));   // 45 degrees up: above the image
}

}  // namespace
}  // namespace dhpmap::evaluator

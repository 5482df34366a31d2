// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/lidar_projection.h"

#include <gtest/gtest.h>

#include <limits>

namespace dhpmap {
namespace {

/// 8 x 4 pixels that look along the LiDAR's x axis (y left, z up), f = 4 px, centre (4, 2).
LidarCamera ForwardCamera() {
  Eigen::Matrix3d K;
  K << 4, 0, 4, 0, 4, 2, 0, 0, 1;
  Eigen::Matrix<double, 3, 4> T_camera_lidar;
  T_camera_lidar << 0, -1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0;
  return {K * T_camera_lidar, 8, 4};
}

/// Point at depth 2 that the camera sees at (u, v).
Eigen::Vector3f PointAt(double u, double v) {
  return {2.0f, static_cast<float>(-(u - 4) / 4 * 2), static_cast<float>(-(v - 2) / 4 * 2)};
}

/// Red grows by 10 a column, green by 20 a row.
Image<Color> Gradient() {
  Image<Color> image{8, 4, {}};
  for (int v = 0; v < 4; ++v) {
    for (int u = 0; u < 8; ++u) {
      image.pixels.push_back({static_cast<std::uint8_t>(10 * u), static_cast<std::uint8_t>(20 * v), 9});
    }
  }
  return image;
}

Image<std::uint32_t> PixelNumbers() {
  Image<std::uint32_t> image{8, 4, {}};
  for (std::uint32_t i = 0; i < 32; ++i) image.pixels.push_back(i);
  return image;
}

TEST(ProjectImagesOntoScan, InterpolatesColourAndTruncatesForIds) {
  LidarData scan;
  scan.points_m = {PointAt(3.5, 1.25), PointAt(2.0, 1.0), PointAt(6.75, 2.75)};
  ASSERT_TRUE(ProjectImagesOntoScan(ForwardCamera(), Gradient(), PixelNumbers(), scan).ok());
  ASSERT_EQ(scan.points_m.size(), 3u);
  EXPECT_EQ(scan.color, (std::vector<Color>{{35, 25, 9}, {20, 20, 9}, {68, 55, 9}}));
  EXPECT_EQ(scan.segments, (std::vector<std::uint32_t>{8 * 1 + 3, 8 * 1 + 2, 8 * 2 + 6}));
}

TEST(ProjectImagesOntoScan, KeepsAPointOnlyIfAllFourNeighboursAreInTheImage) {
  LidarData scan;
  scan.points_m = {PointAt(0, 0),      PointAt(7, 3),       PointAt(6.9375, 2.9375), PointAt(7.0625, 1),
                   PointAt(1, 3.0625), PointAt(-0.0625, 1), PointAt(1, -0.0625),     PointAt(100, 1)};
  ASSERT_TRUE(ProjectImagesOntoScan(ForwardCamera(), Gradient(), PixelNumbers(), scan).ok());
  EXPECT_EQ(scan.segments, (std::vector<std::uint32_t>{0, 31, 8 * 2 + 6}));
}

TEST(ProjectImagesOntoScan, DropsPointsBehindTheCameraAndInItsPlane) {
  LidarData scan;
  scan.points_m = {{-2, 0, 0}, {0, 0, 0}, {2, 0, 0}, {std::numeric_limits<float>::quiet_NaN(), 0, 0}};
  ASSERT_TRUE(ProjectImagesOntoScan(ForwardCamera(), {}, {}, scan).ok());
  ASSERT_EQ(scan.points_m.size(), 1u);
  EXPECT_EQ(scan.points_m[0], Eigen::Vector3f(2, 0, 0));
  EXPECT_TRUE(scan.color.empty());
  EXPECT_TRUE(scan.segments.empty());
}

TEST(ProjectImagesOntoScan, EmptyImagesLeaveWhatThePointsHad) {
  LidarData scan;
  scan.points_m = {{-2, 0, 0}, PointAt(2, 1)};
  scan.color = {{1, 1, 1}, {2, 2, 2}};
  scan.segments = {11, 12};
  ASSERT_TRUE(ProjectImagesOntoScan(ForwardCamera(), {}, {}, scan).ok());
  EXPECT_EQ(scan.color, (std::vector<Color>{{2, 2, 2}}));
  EXPECT_EQ(scan.segments, (std::vector<std::uint32_t>{12}));
}

TEST(ProjectImagesOntoScan, RefusesWhatDoesNotFitAndLeavesTheScan) {
  LidarData scan;
  scan.points_m = {{-2, 0, 0}};
  Image<Color> small = Gradient();
  small.width_px = 7;
  small.pixels.resize(28);
  const Status wrong_size = ProjectImagesOntoScan(ForwardCamera(), small, {}, scan);
  EXPECT_EQ(wrong_size.code(), StatusCode::kInvalidArgument);
  ASSERT_EQ(wrong_size.violations().size(), 1u);
  EXPECT_EQ(wrong_size.violations()[0].field, "color");

  Image<std::uint32_t> short_ids = PixelNumbers();
  short_ids.pixels.pop_back();
  EXPECT_FALSE(ProjectImagesOntoScan(ForwardCamera(), {}, short_ids, scan).ok());

  LidarCamera bad = ForwardCamera();
  bad.P_image_lidar(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ProjectImagesOntoScan(bad, {}, {}, scan).ok());
  bad = ForwardCamera();
  bad.width_px = 0;
  EXPECT_FALSE(ProjectImagesOntoScan(bad, {}, {}, scan).ok());

  scan.segments = {1, 2};
  EXPECT_FALSE(ProjectImagesOntoScan(ForwardCamera(), {}, {}, scan).ok());
  EXPECT_EQ(scan.points_m.size(), 1u);
}

}  // namespace
}  // namespace dhpmap

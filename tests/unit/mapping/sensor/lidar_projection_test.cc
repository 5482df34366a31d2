// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/sensor/lidar_projection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

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

/// A post of near points in the middle of 320 x 240 pixels before a far wall, and points behind the camera.
LidarData PostBeforeAWall() {
  LidarData scan;
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      const float y = 0.05f * static_cast<float>(40 - u), z = 0.05f * static_cast<float>(30 - v);
      scan.points_m.emplace_back(-5.0f, y, z);
      scan.points_m.emplace_back(20.0f, 5 * y, 5 * z);
      if (std::abs(u - 40) < 10) scan.points_m.emplace_back(4.1f, y + 0.02f, z);
    }
  }
  return scan;
}

LidarCamera WideCamera() {
  Eigen::Matrix<double, 3, 4> P;
  P << 160, -320, 0, 0, 120, 0, -320, 0, 1, 0, 0, 0;
  return {P, 320, 240};
}

TEST(ProjectImagesOntoScan, FlagsTheSamePointsWhateverTheScaleOfTheCamerasMatrix) {
  const Image<std::uint32_t> ids{320, 240, std::vector<std::uint32_t>(320 * 240, 7)};
  LidarData plain = PostBeforeAWall();
  ASSERT_TRUE(ProjectImagesOntoScan(WideCamera(), {}, ids, plain).ok());
  for (const double scale : {1e-3, 1e3, 1e30}) {
    LidarCamera camera = WideCamera();
    camera.P_image_lidar *= scale;
    LidarData scan = PostBeforeAWall();
    ASSERT_TRUE(ProjectImagesOntoScan(camera, {}, ids, scan).ok());
    EXPECT_EQ(scan.is_hidden, plain.is_hidden) << scale;
  }
}

TEST(ProjectImagesOntoScan, FlagsPointsThatTakeTheIdOfWhatIsBeforeThem) {
  LidarData scan = PostBeforeAWall();
  const Image<std::uint32_t> ids{320, 240, std::vector<std::uint32_t>(320 * 240, 7)};
  ASSERT_TRUE(ProjectImagesOntoScan(WideCamera(), {}, ids, scan).ok());
  ASSERT_EQ(scan.is_hidden.size(), scan.points_m.size());
  int num_inside = 0;
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    const Eigen::Vector3f& p = scan.points_m[i];
    const float u_px = 160 - 320 * p.y() / p.x();
    const bool is_behind = p.x() > 10 && std::abs(u_px - 160) < 25 && std::abs(p.z()) < 6;
    const bool is_seen = p.x() < 10 || std::abs(u_px - 160) > 45;
    if (is_behind || is_seen) {
      EXPECT_EQ(scan.is_hidden[i], is_behind) << p.transpose();
    }
    num_inside += is_behind;
  }
  EXPECT_GT(num_inside, 500);
}

TEST(ProjectImagesOntoScan, WithoutAnImageOfIdsFlagsAreThoseThatWereThere) {
  LidarData scan = PostBeforeAWall();
  const Image<Color> grey{320, 240, std::vector<Color>(320 * 240, Color{})};
  ASSERT_TRUE(ProjectImagesOntoScan(WideCamera(), grey, {}, scan).ok());
  EXPECT_TRUE(scan.is_hidden.empty()) << "ids of points that were labelled one by one are not the image's";

  LidarData flagged;
  flagged.points_m = {{-2, 0, 0}, PointAt(2, 1), PointAt(3, 1)};
  flagged.is_hidden = {0, 1, 0};
  ASSERT_TRUE(ProjectImagesOntoScan(ForwardCamera(), {}, {}, flagged).ok());
  EXPECT_EQ(flagged.is_hidden, (std::vector<std::uint8_t>{1, 0}));
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

  scan.is_hidden = {1, 0};
  EXPECT_FALSE(ProjectImagesOntoScan(ForwardCamera(), {}, {}, scan).ok());
  scan.is_hidden.clear();
  scan.segments = {1, 2};
  EXPECT_FALSE(ProjectImagesOntoScan(ForwardCamera(), {}, {}, scan).ok());
  EXPECT_EQ(scan.points_m.size(), 1u);
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dhpmap {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kMaxRange_m = 30;

Eigen::Vector3d Direction(double azimuth_rad, double elevation_rad) {
  return {std::cos(azimuth_rad) * std::cos(elevation_rad), std::sin(azimuth_rad) * std::cos(elevation_rad),
          std::sin(elevation_rad)};
}

/// Beams every half degree in azimuth and degree in elevation that all end at one range, `half_width` to either side.
PanopticFrame ScanOfAWall(double range_m, double half_width_deg = 180) {
  PanopticFrame frame;
  LidarData& scan = frame.lidar.emplace();
  for (int a = -360; a < 360; ++a) {
    if (std::abs(0.5 * a) > half_width_deg) continue;
    for (int e = -25; e <= 5; ++e) {
      scan.points_m.push_back((range_m * Direction(0.5 * a * kDegree, e * kDegree)).cast<float>());
    }
  }
  return frame;
}

bool ShouldBeSeen(const PanopticFrame& frame, const BoundingSphere& sphere) {
  return FrameSight(frame, kMaxRange_m).ShouldBeSeen(sphere);
}

TEST(FrameSight, AScannerShowsWhatIsInItsFieldAndNotBehindWhatItMeasured) {
  const PanopticFrame frame = ScanOfAWall(10);
  EXPECT_TRUE(ShouldBeSeen(frame, {{8, 0, 0}, 0.5})) << "it sees past it";
  EXPECT_TRUE(ShouldBeSeen(frame, {{10, 0, 0}, 0.5})) << "it lies there";
  EXPECT_TRUE(ShouldBeSeen(frame, {{-8, 0, -1}, 0.5})) << "all around, on the seam of angles too";
  EXPECT_FALSE(ShouldBeSeen(frame, {{11, 0, 0}, 0.5})) << "behind the wall";
  EXPECT_FALSE(ShouldBeSeen(frame, {{0, 0, 5}, 0.5})) << "no ring looks up there";
  EXPECT_FALSE(ShouldBeSeen(frame, {{0, 0, -5}, 0.5})) << "nor down there";
  EXPECT_FALSE(ShouldBeSeen(frame, {{8, 0, 0}, -1.0})) << "it holds nothing";
  EXPECT_FALSE(ShouldBeSeen(frame, {{0, 0, 0}, 0.5})) << "in no direction";
  EXPECT_FALSE(ShouldBeSeen(ScanOfAWall(100), {{31, 0, 0}, 0.5})) << "out of range";
}

TEST(FrameSight, WhatLeavesTheImageToWhichAScanWasCroppedIsNotOverlooked) {
  const PanopticFrame frame = ScanOfAWall(20, 40);
  EXPECT_TRUE(ShouldBeSeen(frame, {8 * Direction(39 * kDegree, 0), 0.6}));
  EXPECT_FALSE(ShouldBeSeen(frame, {8 * Direction(43 * kDegree, 0), 0.6}));
  EXPECT_FALSE(ShouldBeSeen(frame, {8 * Direction(60 * kDegree, 0), 3.0})) << "though it reaches into the image";
  EXPECT_FALSE(ShouldBeSeen(frame, {8 * Direction(M_PI, 0), 0.6})) << "behind";
  EXPECT_FALSE(ShouldBeSeen(frame, {2 * Direction(80 * kDegree, 0), 2.5})) << "nor where the scanner is within";
}

TEST(FrameSight, WhatFitsBetweenBeamsIsNotOverlooked) {
  const PanopticFrame frame = ScanOfAWall(20);
  const Eigen::Vector3d between = 10 * Direction(0.25 * kDegree, 0.5 * kDegree);
  EXPECT_FALSE(ShouldBeSeen(frame, {between, 10 * 0.4 * kDegree}));
  EXPECT_TRUE(ShouldBeSeen(frame, {between, 10 * 0.7 * kDegree}));
}

TEST(FrameSight, ASilentScanSaysNothing) {
  PanopticFrame frame;
  frame.lidar.emplace();
  EXPECT_FALSE(ShouldBeSeen(frame, {{8, 0, 0}, 0.5}));
  frame.lidar->points_m = {{0, 0, 0}};
  EXPECT_FALSE(ShouldBeSeen(frame, {{8, 0, 0}, 0.5}));
}

TEST(FrameSight, OfTwoReturnsOfOneBeamTheFirstCounts) {
  PanopticFrame frame;
  frame.lidar.emplace();
  for (const bool is_near_first : {true, false}) {
    frame.lidar->points_m = {{16, 0, 0}, {4, 0, 0}};
    if (is_near_first) std::swap(frame.lidar->points_m[0], frame.lidar->points_m[1]);
    EXPECT_FALSE(ShouldBeSeen(frame, {{8, 0, 0}, 0.5}));
    EXPECT_TRUE(ShouldBeSeen(frame, {{4, 0, 0}, 0.5}));
  }
}

/// By all beams, one after the other.
bool ShouldBeSeenByDefinition(const PanopticFrame& frame, const BoundingSphere& sphere) {
  const Eigen::Vector3d p = frame.T_map_sensor.inverse() * sphere.center_m;
  if (p.norm() > kMaxRange_m) return false;
  double nearest_rad = FrameSight::kMostBeamGap_rad, range_m = -1;
  if (sphere.radius_m < p.norm()) nearest_rad = std::min(nearest_rad, std::asin(sphere.radius_m / p.norm()));
  for (const Eigen::Vector3f& beam : frame.lidar->points_m) {
    const Eigen::Vector3d b = beam.cast<double>();
    const double angle_rad = std::atan2(b.cross(p).norm(), b.dot(p));
    if (angle_rad > nearest_rad) continue;
    nearest_rad = angle_rad;
    range_m = b.norm();
  }
  return range_m >= 0 && range_m >= p.norm() - sphere.radius_m;
}

TEST(FrameSight, IsWhatAllBeamsSayFromAnyPose) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(-1, 1), length_m(0.5, 35);
  const auto any_direction = [&] {
    Eigen::Vector3d d;
    do d = {coordinate(random), coordinate(random), coordinate(random)};
    while (d.norm() > 1 || d.norm() < 0.1);
    return Eigen::Vector3d(d.normalized());
  };
  PanopticFrame frame;
  LidarData& scan = frame.lidar.emplace();
  for (int i = 0; i < 20000; ++i) scan.points_m.push_back((length_m(random) * any_direction()).cast<float>());
  frame.T_map_sensor.linear() = Eigen::AngleAxisd(2.1, any_direction()).toRotationMatrix();
  frame.T_map_sensor.translation() = Eigen::Vector3d(300, -20, 7);
  FrameSight sight(frame, kMaxRange_m);
  int num_seen = 0;
  for (int i = 0; i < 1000; ++i) {
    const BoundingSphere sphere{frame.T_map_sensor * (length_m(random) * any_direction()), 0.05 * length_m(random)};
    const bool is_seen = ShouldBeSeenByDefinition(frame, sphere);
    EXPECT_EQ(sight.ShouldBeSeen(sphere), is_seen) << i;
    num_seen += is_seen;
  }
  EXPECT_GT(num_seen, 200);
  EXPECT_LT(num_seen, 800);
}

TEST(FrameSight, ACameraShowsWhatIsInItsImageAndNotBehindWhatItMeasured) {
  PanopticFrame frame;
  DepthCameraData& data = frame.camera.emplace();
  data.camera = {.width_px = 40, .height_px = 30, .fx_px = 20, .fy_px = 20, .cx_px = 20, .cy_px = 15};
  data.depth_m.assign(40 * 30, 5.0f);
  EXPECT_TRUE(ShouldBeSeen(frame, {{0, 0, 4}, 0.2}));
  EXPECT_TRUE(ShouldBeSeen(frame, {{0, 0, 5.1}, 0.2}));
  EXPECT_FALSE(ShouldBeSeen(frame, {{0, 0, 6}, 0.2}));
  EXPECT_FALSE(ShouldBeSeen(frame, {{5, 0, 4}, 2.0}));
  EXPECT_FALSE(ShouldBeSeen(frame, {{0, 0, -4}, 0.2}));
  std::fill(data.depth_m.begin(), data.depth_m.end(), 0.0f);
  EXPECT_FALSE(ShouldBeSeen(frame, {{0, 0, 4}, 0.2})) << "a pixel without a return says nothing";
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
// Rays are cast from the scanner and from the camera at boxes, so which points the camera sees is known exactly.
#include "mapping/sensor/camera_occlusion.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

namespace dhpmap {
namespace {

constexpr int kWidth_px = 1241, kHeight_px = 376;
constexpr double kFocal_px = 707, kCentreU_px = 602, kCentreV_px = 183;
constexpr double kDegree = M_PI / 180;

struct Box {
  Eigen::Array3d low_m, high_m;
};

/// How far along the ray the nearest box is; infinite if it meets none.
double Cast(const std::vector<Box>& boxes, const Eigen::Vector3d& eye_m, const Eigen::Vector3d& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Box& box : boxes) {
    const Eigen::Array3d a = (box.low_m - eye_m.array()) / ray.array(), b = (box.high_m - eye_m.array()) / ray.array();
    const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
    if (enter > 0 && enter < leave) nearest = std::min(nearest, enter);
  }
  return nearest;
}

/// x forward, y left, z up; the camera at `eye` looks along x.
struct Camera {
  Eigen::Vector3d eye_m;

  [[nodiscard]] std::optional<ProjectedPoint> See(const Eigen::Vector3d& p_m) const {
    const Eigen::Vector3d q = p_m - eye_m;
    const double u = kCentreU_px - kFocal_px * q.y() / q.x(), v = kCentreV_px - kFocal_px * q.z() / q.x();
    if (!(q.x() > 0 && u >= 0 && v >= 0 && u <= kWidth_px - 1 && v <= kHeight_px - 1)) return std::nullopt;
    return ProjectedPoint{static_cast<float>(u), static_cast<float>(v), static_cast<float>(q.x())};
  }
  [[nodiscard]] Eigen::Vector3d RayOf(double u_px, double v_px) const {
    return {1, (kCentreU_px - u_px) / kFocal_px, (kCentreV_px - v_px) / kFocal_px};
  }
};

struct Scanner {
  Eigen::Vector3d eye_m{0, 0, 0};
  int num_rows = 64;
  double top_deg = 3, row_deg = 27.0 / 63, column_deg = 0.18;
};

struct Scan {
  std::vector<ProjectedPoint> points;
  std::vector<Eigen::Vector3d> places_m;
};

Scan ScanOf(const std::vector<Box>& boxes, const Scanner& scanner, const Camera& camera) {
  Scan scan;
  for (int row = 0; row < scanner.num_rows; ++row) {
    const double elevation = (scanner.top_deg - row * scanner.row_deg) * kDegree;
    for (int column = 0; - 50.01 + column * scanner.column_deg < 50; ++column) {
      const double azimuth = (-50.01 + column * scanner.column_deg) * kDegree;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      const double range_m = Cast(boxes, scanner.eye_m, ray);
      if (!std::isfinite(range_m)) continue;
      const Eigen::Vector3d place_m = scanner.eye_m + range_m * ray;
      if (const auto point = camera.See(place_m)) {
        scan.points.push_back(*point);
        scan.places_m.push_back(place_m);
      }
    }
  }
  return scan;
}

const Box kGround{{-100, -100, -2.73}, {100, 100, -1.73}};
const Box kWall{{20, -100, -3}, {21, 100, 15}};
const Box kCar{{8, -1.5, -1.7}, {9.5, 1.5, -0.5}};

/// Below this ground and things meet, and there the nearer ground before a thing may enclose what is beside it.
constexpr double kFoot_m = -1.73 + 0.1;

struct Tally {
  std::size_t num_hidden = 0, num_found = 0, num_seen = 0, num_wrong = 0;
  std::size_t num_wrong_above_foot = 0;
};

/// Compares flags with the truth, leaving out points with an edge of what is before them within `rim_px`.
Tally Compare(const std::vector<Box>& boxes, const Scan& scan, const Camera& camera, double rim_px) {
  const auto is_hidden = FindHiddenPoints(scan.points, kWidth_px, kHeight_px);
  Tally tally;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const ProjectedPoint& p = scan.points[i];
    int num_behind = 0;
    for (const double du : {-rim_px, 0.0, rim_px}) {
      for (const double dv : {-rim_px, 0.0, rim_px}) {
        num_behind += Cast(boxes, camera.eye_m, camera.RayOf(p.u_px + du, p.v_px + dv)) < p.depth_m * 0.85;
      }
    }
    if (num_behind == 9) ++tally.num_hidden, tally.num_found += is_hidden[i];
    if (num_behind != 0) continue;
    ++tally.num_seen, tally.num_wrong += is_hidden[i];
    tally.num_wrong_above_foot += is_hidden[i] != 0 && scan.places_m[i].z() > kFoot_m;
  }
  return tally;
}

std::ptrdiff_t NumHidden(const Scan& scan) {
  const auto is_hidden = FindHiddenPoints(scan.points, kWidth_px, kHeight_px);
  EXPECT_EQ(is_hidden.size(), scan.points.size());
  return std::count(is_hidden.begin(), is_hidden.end(), 1);
}

TEST(FindHiddenPoints, FindsWhatAScannerAboveTheCameraSeesBehindACar) {
  const Camera camera{{0.3, 0, -0.5}};
  const std::vector<Box> boxes = {kGround, kWall, kCar};
  const Scan scan = ScanOf(boxes, {}, camera);
  const Tally tally = Compare(boxes, scan, camera, 6);
  ASSERT_GT(tally.num_hidden, 200u);
  ASSERT_GT(tally.num_seen, 10'000u);
  EXPECT_GE(tally.num_found, tally.num_hidden * 98 / 100) << tally.num_found << " of " << tally.num_hidden;
  EXPECT_EQ(tally.num_wrong_above_foot, 0u);
  EXPECT_LE(tally.num_wrong, tally.num_seen / 1000) << "at its foot";
}

TEST(FindHiddenPoints, FindsWhatAScannerBesideTheCameraSeesBehindACar) {
  const Camera camera{{0.3, 0.6, -0.1}};
  const std::vector<Box> boxes = {kGround, kWall, kCar};
  const Scan scan = ScanOf(boxes, {}, camera);
  const Tally tally = Compare(boxes, scan, camera, 6);
  ASSERT_GT(tally.num_hidden, 100u);
  EXPECT_GE(tally.num_found, tally.num_hidden * 98 / 100) << tally.num_found << " of " << tally.num_hidden;
  EXPECT_EQ(tally.num_wrong, 0u);
}

TEST(FindHiddenPoints, CallsNoSeenPointHiddenRightUpToTheSilhouette) {
  for (const Camera& camera : {Camera{{0.3, 0, -0.5}}, Camera{{0.3, 0.6, -0.1}}, Camera{{0.3, -0.6, 0.4}}}) {
    const std::vector<Box> boxes = {kGround, kWall, kCar, Box{{5, 3, -1.7}, {5.2, 3.2, 2}}};  // and a post
    const Scan scan = ScanOf(boxes, {}, camera);
    const Tally tally = Compare(boxes, scan, camera, 0);
    ASSERT_GT(tally.num_hidden, 100u);
    EXPECT_EQ(tally.num_wrong_above_foot, 0u) << "of " << tally.num_seen;
    EXPECT_LE(tally.num_wrong, tally.num_seen / 500) << "at a foot";
  }
}

TEST(FindHiddenPoints, BridgesTheGapsOfAScannerWithFewBeams) {
  const Camera camera{{0.3, 0, -0.8}};
  const std::vector<Box> boxes = {kGround, kWall, Box{{8, -1.5, -1.7}, {9.5, 1.5, 0.4}}};
  const Scan scan = ScanOf(boxes, {.num_rows = 16, .top_deg = 15, .row_deg = 2, .column_deg = 0.2}, camera);
  const Tally tally = Compare(boxes, scan, camera, 26);
  ASSERT_GT(tally.num_hidden, 30u);
  EXPECT_GE(tally.num_found, tally.num_hidden * 95 / 100) << tally.num_found << " of " << tally.num_hidden;
  EXPECT_EQ(tally.num_wrong, 0u);
}

TEST(FindHiddenPoints, AScannerWhereTheCameraIsSeesNothingHidden) {
  const Camera camera{{0, 0, 0}};
  EXPECT_EQ(NumHidden(ScanOf({kWall, kCar}, {}, camera)), 0);
  const Scan scan = ScanOf({kGround, kWall, kCar}, {}, camera);
  EXPECT_LE(NumHidden(scan) * 1000, static_cast<std::ptrdiff_t>(scan.points.size()));  // at its foot
}

TEST(FindHiddenPoints, NoPartOfAPlaneIsHidden) {
  const Camera camera{{0.3, 0.1, -0.1}};
  EXPECT_EQ(NumHidden(ScanOf({kGround}, {}, camera)), 0);                                 // grazed up to 100 m away
  EXPECT_EQ(NumHidden(ScanOf({kWall}, {}, camera)), 0);                                   // upright
  EXPECT_EQ(NumHidden(ScanOf({{{-100, 2, -3}, {100, 3, 15}}}, {}, camera)), 0);           // grazed, beside the street
  EXPECT_EQ(NumHidden(ScanOf({kGround, {{-100, 2, -3}, {100, 3, 15}}}, {}, camera)), 0);  // and with a corner
}

TEST(FindHiddenPoints, GroundBeyondALowThingIsSeen) {
  const Camera camera{{0.3, 0, -0.1}};
  const std::vector<Box> boxes = {kGround, {{6, -3, -1.73}, {6.3, 3, -1.4}}};
  const Scan scan = ScanOf(boxes, {}, camera);
  const Tally tally = Compare(boxes, scan, camera, 0);
  EXPECT_EQ(tally.num_wrong_above_foot, 0u);
  EXPECT_LE(tally.num_wrong, tally.num_seen / 1000) << "at its foot";
}

TEST(FindHiddenPoints, WhatIsSeenBetweenTwoThingsIsNotHidden) {
  const Camera camera{{0.3, 0, -0.3}};
  const std::vector<Box> boxes = {kGround, kWall, {{8, 0.4, -1.7}, {9, 2, 0.4}}, {{8, -2, -1.7}, {9, -0.4, 0.4}}};
  const Scan scan = ScanOf(boxes, {}, camera);
  const auto is_hidden = FindHiddenPoints(scan.points, kWidth_px, kHeight_px);
  std::size_t num_between = 0, num_wrong = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (scan.places_m[i].x() < 19 || scan.places_m[i].z() < kFoot_m || std::abs(scan.points[i].u_px - kCentreU_px) > 30)
      continue;
    ++num_between;
    num_wrong += is_hidden[i];
  }
  ASSERT_GT(num_between, 100u);
  EXPECT_EQ(num_wrong, 0u);
}

TEST(FindHiddenPoints, TheOrderOfPointsDoesNotMatter) {
  const Scan scan = ScanOf({kGround, kWall, kCar}, {}, Camera{{0.3, 0.4, -0.5}});
  const auto is_hidden = FindHiddenPoints(scan.points, kWidth_px, kHeight_px);
  std::vector<std::size_t> order(scan.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(7));
  std::vector<ProjectedPoint> shuffled;
  shuffled.reserve(order.size());
  for (const std::size_t i : order) shuffled.push_back(scan.points[i]);
  const auto again = FindHiddenPoints(shuffled, kWidth_px, kHeight_px);
  ASSERT_GT(std::count(again.begin(), again.end(), 1), 100);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(again[i], is_hidden[order[i]]);
}

TEST(FindHiddenPoints, TakesNoPointsASingleRowAndASmallImage) {
  EXPECT_TRUE(FindHiddenPoints({}, kWidth_px, kHeight_px).empty());
  std::vector<ProjectedPoint> row;
  row.reserve(9);
  for (int u = 0; u < 8; ++u) row.push_back({static_cast<float>(u), 1, u % 2 == 0 ? 2.0f : 9.0f});
  EXPECT_EQ(FindHiddenPoints(row, 8, 4), std::vector<std::uint8_t>(8, 0));
  row.push_back({7, 3, 9});
  EXPECT_EQ(FindHiddenPoints(row, 8, 4).size(), 9u);
  EXPECT_EQ(FindHiddenPoints(std::vector<ProjectedPoint>{{0, 0, 1}}, 1, 1), std::vector<std::uint8_t>(1, 0));
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/body_triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

constexpr int kSamples = 40;

Eigen::Vector3d RandomPoint(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return {unit(random), unit(random), unit(random)};
}

TriangleCorners RandomTriangle(std::mt19937& random) {
  const Eigen::Vector3d middle = RandomPoint(random);
  TriangleCorners t;
  for (auto& corner : t) corner = (middle + 0.6 * RandomPoint(random)).cast<float>();
  return t;
}

/// Points all over a triangle.
std::vector<Eigen::Vector3d> Samples(const TriangleCorners& t) {
  std::vector<Eigen::Vector3d> samples;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; i + j <= kSamples; ++j) {
      const float u = static_cast<float>(i) / kSamples, v = static_cast<float>(j) / kSamples;
      samples.push_back((t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0])).cast<double>());
    }
  }
  return samples;
}

TEST(NearestPointsOf, EqualsTheNearestOfManySamples) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const TriangleCorners t = RandomTriangle(random);
    const std::array<Eigen::Vector3d, 3> exact = {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()};
    const Eigen::Vector3d a = RandomPoint(random), b = RandomPoint(random);
    const NearestPoints nearest = NearestPointsOf(a, b, t);
    const double distance_m = std::sqrt(nearest.distance2);
    double sampled_m = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= 200; ++i) {
      sampled_m = std::min(sampled_m, testing::DistanceToTriangle(a + i / 200.0 * (b - a), exact));
    }
    const double step_m = (b - a).norm() / 200;
    EXPECT_LE(distance_m, sampled_m + 1e-6);
    EXPECT_GE(distance_m, sampled_m - step_m);
    EXPECT_NEAR((nearest.on_segment - nearest.on_triangle).norm(), distance_m, 1e-6);
    EXPECT_NEAR(testing::DistanceToTriangle(nearest.on_triangle, exact), 0, 1e-5);
    if (nearest.is_through) {
      EXPECT_EQ(distance_m, 0);
    }
  }
}

TEST(TouchOf, BoxesTouchWhatHasAPointInThem) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> size(0.05, 0.5);
  int num_touching = 0, num_padded = 0;
  for (int round = 0; round < 2000; ++round) {
    const TriangleCorners t = RandomTriangle(random);
    OrientedBox box{testing::RandomPose(random, 0.7), {size(random), size(random), size(random)}};
    const double padding_m = round % 2 == 0 ? 0 : 0.15;
    const testing::Solid solid{.shape = testing::Solid::Shape::kBox, .center_m = {0, 0, 0}, .size_m = box.half_m};
    double least_m = std::numeric_limits<double>::infinity();
    const Transform T_box_world = box.T_world_box.inverse();
    for (const Eigen::Vector3d& p : Samples(t)) least_m = std::min(least_m, solid.Distance(T_box_world * p));
    const auto touch = TouchOf(box, t, padding_m);
    if (least_m < padding_m - 1e-6) {
      EXPECT_TRUE(touch) << least_m;
    }
    if (least_m > padding_m + 0.04) {  // more than samples are apart
      EXPECT_FALSE(touch) << least_m;
    }
    if (!touch) continue;
    ++(padding_m > 0 ? num_padded : num_touching);
    EXPECT_LE(solid.Distance(T_box_world * touch->point), padding_m + 1e-5);
    // Taken along the normal by the depth, the box is in front of the plane, and touches it.
    OrientedBox off = box;
    off.T_world_box.translation() += (touch->depth_m - padding_m) * touch->normal;
    if (padding_m > 0) continue;
    const Eigen::Vector3d n = off.T_world_box.linear().transpose() * touch->normal;
    const double lowest =
        touch->normal.dot(off.T_world_box.translation() - t[0].cast<double>()) - n.cwiseAbs().dot(off.half_m);
    EXPECT_NEAR(lowest, 0, 1e-5);
  }
  EXPECT_GT(num_touching, 50);
  EXPECT_GT(num_padded, 50);
}

TEST(TouchOf, ACapsuleIsAsDeepAsItReachesBehind) {
  const TriangleCorners floor = {Eigen::Vector3f(-1, -1, 0), {2, -1, 0}, {-1, 2, 0}};  // faces up
  const auto above = TouchOf(Capsule{{0, 0, 0.08}, {0.1, 0, 0.2}, 0.1}, floor, 0);
  ASSERT_TRUE(above);
  EXPECT_NEAR(above->depth_m, 0.02, 1e-6);
  EXPECT_NEAR((above->point - Eigen::Vector3d(0, 0, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR(above->normal.z(), 1, 1e-6);
  const auto through = TouchOf(Capsule{{0, 0, -0.05}, {0.1, 0, 0.2}, 0.1}, floor, 0.01);
  ASSERT_TRUE(through);
  EXPECT_NEAR(through->depth_m, 0.16, 1e-6);
  EXPECT_FALSE(TouchOf(Capsule{{0, 0, 0.12}, {0.1, 0, 0.2}, 0.1}, floor, 0));
  EXPECT_TRUE(TouchOf(Capsule{{0, 0, 0.12}, {0.1, 0, 0.2}, 0.1}, floor, 0.03));
}

TEST(TouchOf, WhatHasNoAreaIsHarmless) {
  const TriangleCorners point = {Eigen::Vector3f(0, 0, 0), {0, 0, 0}, {0, 0, 0}};
  for (const double padding_m : {0.0, 0.1}) {
    (void)TouchOf(Capsule{{0, 0, 0.1}, {0.1, 0, 0.2}, 0.05}, point, padding_m);
    (void)TouchOf(OrientedBox{Transform::Identity(), {0.1, 0.1, 0.1}}, point, padding_m);
  }
}

}  // namespace
}  // namespace dhpmap

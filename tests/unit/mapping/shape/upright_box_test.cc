// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/shape/upright_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dhpmap {
namespace {

const UprightBox kUnit{.center_m = {1, 2, 3}, .yaw_rad = 0, .size_m = {1, 1, 1}};

TEST(UprightBox, OverAFootprintStandsOnIt) {
  const UprightBox box = BoxOver({{0, 0}, {2, 2}, {1, 3}, {-1, 1}}, -1, 0.5);
  EXPECT_TRUE(box.center_m.isApprox(Eigen::Vector3d(0.5, 1.5, -0.25), 1e-12));
  EXPECT_TRUE(box.size_m.isApprox(Eigen::Vector3d(2 * std::sqrt(2.0), std::sqrt(2.0), 1.5), 1e-12));
  EXPECT_NEAR(box.yaw_rad, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(AreaOf(FootprintOf(box)), 4, 1e-12);
}

TEST(UprightBox, ShareWithAnotherIsOneOnlyForTheSame) {
  EXPECT_NEAR(IntersectionOverUnion(kUnit, kUnit), 1, 1e-12);
  UprightBox quarter = kUnit;
  quarter.yaw_rad = std::numbers::pi / 2;
  EXPECT_NEAR(IntersectionOverUnion(kUnit, quarter), 1, 1e-12);
}

TEST(UprightBox, ShareOfAnotherBesideItIsThatOfTheOverlap) {
  UprightBox beside = kUnit;
  beside.center_m += Eigen::Vector3d(0.5, 0, 0.5);
  EXPECT_NEAR(IntersectionOverUnion(kUnit, beside), 0.25 / 1.75, 1e-12);
  beside.center_m.z() += 1;
  EXPECT_EQ(IntersectionOverUnion(kUnit, beside), 0);
}

TEST(UprightBox, ShareOfOneTurnedByAnEighthIsThatOfAnOctagon) {
  UprightBox turned = kUnit;
  turned.yaw_rad = std::numbers::pi / 4;
  const double octagon = 2 * std::sqrt(2.0) - 2;
  EXPECT_NEAR(IntersectionOverUnion(kUnit, turned), octagon / (2 - octagon), 1e-12);
}

TEST(UprightBox, WithoutAVolumeSharesNothing) {
  const UprightBox flat{.center_m = {1, 2, 3}, .yaw_rad = 0, .size_m = {1, 1, 0}};
  EXPECT_EQ(IntersectionOverUnion(flat, flat), 0);
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/submap_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "mapping/submap/upper_side.h"
#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

using testing::SolidDistance;

constexpr double kDegree = std::numbers::pi / 180;
const Eigen::Vector3d kCenter(0.32, -0.11, 0.45);
const Eigen::Vector3d kHalf(0.5, 0.3, 0.4);

/// A block that is turned about the vertical through its middle.
SolidDistance TurnedBlock(double yaw_rad) {
  const SolidDistance block = testing::Block(kCenter, kHalf);
  const Eigen::Matrix3d back = Eigen::AngleAxisd(-yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return [=](const Eigen::Vector3d& p) { return block(kCenter + back * (p - kCenter)); };
}

class SubmapOutlineTest : public ::testing::Test {
 protected:
  Submap& Add(const SolidDistance& distance) {
    Submap& submap = testing::AddThing(map_);
    testing::ObserveBand(submap, distance, testing::CubeAt(kCenter, 1.0));
    return submap;
  }
  /// Some voxels of surface far from it.
  static void AddStrays(Submap& submap, float weight) {
    TsdfBlock& block = submap.MutableTsdf({4, 0, 1});
    for (std::size_t i = 0; i < 3; ++i) {
      block.distance_m[i] = i % 2 == 0 ? 0.02f : -0.02f;
      block.weight[i] = weight;
    }
    submap.UpdateBoundingSphere();
  }

  Map map_{testing::SceneInfo()};
};

TEST_F(SubmapOutlineTest, BoxIsThatOfTheSolidHoweverItIsTurned) {
  for (const double degrees : {0.0, 10.0, 33.0, 45.0, 77.0, -20.0}) {
    const auto outline = OutlineInMap(Add(TurnedBlock(degrees * kDegree)));
    ASSERT_TRUE(outline);
    EXPECT_LT((outline->box.center_m - kCenter).norm(), 0.015) << degrees;
    EXPECT_LT((outline->box.size_m - 2 * kHalf).cwiseAbs().maxCoeff(), 0.04) << degrees;
    EXPECT_NEAR(std::remainder(outline->box.yaw_rad / kDegree - degrees, 180), 0, 2) << degrees;
    const UprightBox truth{.center_m = kCenter, .yaw_rad = degrees * kDegree, .size_m = 2 * kHalf};
    EXPECT_GT(IntersectionOverUnion(outline->box, truth), 0.9) << degrees;
  }
}

TEST_F(SubmapOutlineTest, FootprintIsWithinTheBoxAndRoundOfABall) {
  const auto outline = OutlineInMap(Add(testing::Ball(kCenter, 0.4)));
  ASSERT_TRUE(outline);
  const double area_m2 = AreaOf(outline->footprint_m);
  EXPECT_NEAR(area_m2, std::numbers::pi * 0.16, 0.06);
  EXPECT_LT(area_m2, 0.9 * AreaOf(FootprintOf(outline->box)));
  EXPECT_NEAR(AreaOf(Intersection(outline->footprint_m, FootprintOf(outline->box))), area_m2, 1e-9);
}

TEST_F(SubmapOutlineTest, WhatFewFramesHaveSeenFarOffIsLeftOut) {
  Submap& submap = Add(TurnedBlock(0));
  const auto before = OutlineInMap(submap);
  AddStrays(submap, 0.01f);
  const OutlineRules none{.least_weight = 0, .stray_share = 0, .disc_vox = 0, .layer_share = 0};
  ASSERT_GT(OutlineInMap(submap, none)->box.size_m.x(), before->box.size_m.x() + 0.3) << "they are there";
  EXPECT_TRUE(OutlineInMap(submap)->box.size_m.isApprox(before->box.size_m, 1e-9));
}

TEST_F(SubmapOutlineTest, AFewStraysMoveNoSideByAVoxel) {
  Submap& submap = Add(TurnedBlock(0));
  const auto before = OutlineInMap(submap);
  AddStrays(submap, 1);
  EXPECT_LT((OutlineInMap(submap)->box.size_m - before->box.size_m).cwiseAbs().maxCoeff(), testing::kSceneVoxel_m);
}

TEST_F(SubmapOutlineTest, GoesAlongWithMovesAndTurns) {
  Submap& submap = Add(TurnedBlock(20 * kDegree));
  const SubmapOutline before = *OutlineInMap(submap);
  const Transform motion(Eigen::Translation3d(3, -2, 0.5) * Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ()));
  submap.mutable_info().T_map_submap = motion;
  const SubmapOutline after = *OutlineInMap(submap);
  EXPECT_TRUE(after.box.center_m.isApprox(motion * before.box.center_m, 1e-9));
  EXPECT_TRUE(after.box.size_m.isApprox(before.box.size_m, 1e-9));
  EXPECT_NEAR(std::remainder(after.box.yaw_rad - before.box.yaw_rad - 1.1, std::numbers::pi), 0, 1e-9);
  EXPECT_NEAR(*after.support_height_m, *before.support_height_m + 0.5, 1e-9);
  ASSERT_EQ(after.footprint_m.size(), before.footprint_m.size());
  EXPECT_NEAR(AreaOf(after.footprint_m), AreaOf(before.footprint_m), 1e-9);
}

TEST_F(SubmapOutlineTest, OfWhatLiesOnItsSideIsUpright) {
  Submap& submap = Add(TurnedBlock(0));
  submap.mutable_info().T_map_submap = Transform(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()));
  const SubmapOutline outline = *OutlineInMap(submap);
  EXPECT_LT((outline.box.size_m - Eigen::Vector3d(1.0, 0.8, 0.6)).cwiseAbs().maxCoeff(), 0.04);
  EXPECT_LT((outline.box.center_m - submap.info().T_map_submap * kCenter).norm(), 0.015);
}

TEST_F(SubmapOutlineTest, LevellingIsTheSameForPosesThatDifferByRounding) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  const std::vector<Transform> poses = {Transform::Identity(), Transform(Eigen::AngleAxisd(std::numbers::pi / 2, x)),
                                        Transform(Eigen::AngleAxisd(-std::numbers::pi / 2, y)),
                                        Transform(Eigen::AngleAxisd(std::numbers::pi, x)),
                                        Transform(Eigen::AngleAxisd(std::numbers::pi, y))};
  for (const Transform& pose : poses) {
    const Eigen::Matrix3d levelling = LevellingOf(pose);
    EXPECT_LT((levelling * pose.linear().row(2).transpose() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    for (const Eigen::Vector3d& axis : {x, y, Eigen::Vector3d(-x)}) {
      const Transform rounded = Transform(Eigen::AngleAxisd(1e-10, axis)) * pose;
      EXPECT_LT((LevellingOf(rounded) - levelling).cwiseAbs().maxCoeff(), 1e-9) << pose.linear();
    }
  }
}

TEST_F(SubmapOutlineTest, OfWhatHasNoSurfaceIsNone) {
  Submap& submap = testing::AddThing(map_);
  EXPECT_FALSE(OutlineInMap(submap));
  submap.MutableTsdf({0, 0, 0}).weight.fill(1);  // all at a distance of 0: nothing is behind
  EXPECT_FALSE(OutlineInMap(submap));
  EXPECT_FALSE(MiddleOfUpperSide(submap));
}

/// A seat at 0.45 m with a back up to 0.9 m.
SolidDistance Seat() {
  const SolidDistance seat = testing::Block({0.3, -0.1, 0.4}, {0.3, 0.3, 0.05}),
                      back = testing::Block({0.05, -0.1, 0.65}, {0.05, 0.3, 0.25});
  return [=](const Eigen::Vector3d& p) { return std::min(seat(p), back(p)); };
}

TEST_F(SubmapOutlineTest, SupportIsTheSeatAndNotTheEdgeOfTheBack) {
  Submap& submap = Add(Seat());
  const auto outline = OutlineInMap(submap);
  ASSERT_TRUE(outline->support_height_m);
  EXPECT_NEAR(*outline->support_height_m, 0.45, 0.01);
  const auto middle = MiddleOfUpperSide(submap);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x(), 0.35, 0.05);
  EXPECT_NEAR(middle->y(), -0.1, 0.03);
  EXPECT_NEAR(middle->z(), 0.45, 0.01);
}

TEST_F(SubmapOutlineTest, TheSurfaceFromAboveIsTheHighestThere) {
  Submap& submap = Add(Seat());
  submap.mutable_info().T_map_submap = Transform(Eigen::Translation3d(1, 0, 0.2));
  EXPECT_NEAR(SurfaceFromAbove(submap, {1.4, -0.1})->z(), 0.65, 0.01);
  EXPECT_NEAR(SurfaceFromAbove(submap, {1.05, -0.1})->z(), 1.1, 0.02);
  EXPECT_FALSE(SurfaceFromAbove(submap, {2.0, -0.1}));
}

TEST_F(SubmapOutlineTest, NothingStandsOnABall) {
  Submap& submap = Add(testing::Ball(kCenter, 0.4));
  EXPECT_FALSE(OutlineInMap(submap)->support_height_m);
  EXPECT_FALSE(MiddleOfUpperSide(submap));
  EXPECT_NEAR(SurfaceFromAbove(submap, kCenter.head<2>())->z(), kCenter.z() + 0.4, 0.02);
}

TEST_F(SubmapOutlineTest, AlignedBoxIsAroundTheFootprint) {
  const SubmapOutline outline = *OutlineInMap(Add(TurnedBlock(45 * kDegree)));
  const Eigen::AlignedBox3d box = BoxAround(outline);
  EXPECT_TRUE(box.center().isApprox(outline.box.center_m, 0.02));
  EXPECT_NEAR(box.sizes().x(), 1.6 / std::sqrt(2), 0.06);
  EXPECT_NEAR(box.sizes().z(), outline.box.size_m.z(), 1e-12);
}

}  // namespace
}  // namespace dhpmap

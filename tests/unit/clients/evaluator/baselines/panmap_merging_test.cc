// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/panmap_merging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dhpmap::evaluator {
namespace {

constexpr double kBallVoxel_m = 0.04, kBallTruncation_m = 0.08;
constexpr float kWeight = 100.0f;

/// A ball of 40 cm radius, all of whose voxels are its own; inactive.
std::unique_ptr<PanmapSubmap> Ball(std::uint32_t id, const Eigen::Vector3d& center_m, ClassId class_id = ClassId(1)) {
  SubmapInfo info;
  info.id = SubmapId(id);
  info.class_id = class_id;
  info.panoptic = Panoptic::kThing;
  info.voxel_size_m = kBallVoxel_m;
  info.truncation_m = kBallTruncation_m;
  info.activity = Activity::kInactive;
  auto ball = std::make_unique<PanmapSubmap>(std::move(info), 0);
  const VoxelIndex low = VoxelAt(center_m - Eigen::Vector3d::Constant(0.6), kBallVoxel_m);
  for (int z = 0; z < 30; ++z) {
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 30; ++x) {
        const VoxelIndex v{low.x + x, low.y + y, low.z + z};
        const double sdf_m = (VoxelCentre(v, kBallVoxel_m) - center_m).norm() - 0.4;
        if (std::abs(sdf_m) > kBallTruncation_m) continue;
        const auto i = static_cast<std::size_t>(LinearIndex(v));
        TsdfBlock& block = ball->geometry.MutableTsdf(BlockOf(v));
        block.distance_m[i] = static_cast<float>(sdf_m);
        block.weight[i] = kWeight;
        ball->belonging[BlockOf(v)].Add(i, true);
      }
    }
  }
  ball->geometry.UpdateBoundingSphere();
  return ball;
}

PanmapSettings Settings() { return PanmapSettingsFor(PanopticFrame()); }

TEST(BelongingBlockTest, ItIsTheSubmapsUnlessMoreSaysOtherwise) {
  BelongingBlock block;
  EXPECT_TRUE(block.Belongs(7));
  block.Add(7, false);
  EXPECT_FALSE(block.Belongs(7));
  block.Add(7, true);
  EXPECT_TRUE(block.Belongs(7));
  EXPECT_TRUE(block.Belongs(8));
}

TEST(BelongingBlockTest, CountsAreHalvedWhenAByteIsFull) {
  BelongingBlock block;
  for (int i = 0; i < 256; ++i) block.Add(0, true);
  for (int i = 0; i < 10; ++i) block.Add(1, false);
  EXPECT_EQ(block.NumBelonging(0), 128);
  EXPECT_EQ(block.NumForeign(1), 10);
  for (int i = 0; i < 129; ++i) block.Add(0, false);  // so that it follows changes
  EXPECT_FALSE(block.Belongs(0));
}

TEST(CompareSurfacesTest, TellsMatchConflictAndApart) {
  const auto ball = Ball(1, {0, 0, 0});
  EXPECT_EQ(CompareSurfaces(*ball, *Ball(2, {0.01, 0, 0}), Settings()), SurfaceRelation::kMatch);
  // Four centimetres and more behind the other's surface, on one side.
  EXPECT_EQ(CompareSurfaces(*ball, *Ball(2, {0.065, 0, 0}), Settings()), SurfaceRelation::kConflict);
  EXPECT_EQ(CompareSurfaces(*ball, *Ball(2, {1.5, 0, 0}), Settings()), SurfaceRelation::kApart);
}

TEST(CompareSurfacesTest, WhatIsForeignToTheOtherIsNoMatch) {
  const auto ball = Ball(1, {0, 0, 0}), other = Ball(2, {0, 0, 0});
  for (auto& [index, block] : other->belonging) {
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      block.Add(i, false);
      block.Add(i, false);
    }
  }
  EXPECT_EQ(CompareSurfaces(*ball, *other, Settings()), SurfaceRelation::kApart);
}

TEST(MergeWithInactiveTest, JoinsTheSameObjectAndNothingElse) {
  PanmapSubmaps submaps;
  submaps.push_back(Ball(1, {0.01, 0, 0}));
  submaps.push_back(Ball(2, {0, 0, 0}, ClassId(2)));  // of another class
  submaps.push_back(Ball(3, {0, 0, 0}));
  submaps.back()->geometry.mutable_info().activity = Activity::kActive;
  submaps.push_back(Ball(4, {0.065, 0, 0}));  // in conflict
  submaps.push_back(Ball(5, {0, 0, 0}));
  EXPECT_TRUE(MergeWithInactive(SubmapId(5), MapConfig(), Settings(), submaps));
  ASSERT_EQ(submaps.size(), 4u);
  EXPECT_EQ(submaps[0]->geometry.id(), SubmapId(1));
  EXPECT_EQ(submaps[3]->geometry.id(), SubmapId(4));
  float heaviest = 0;
  for (const BlockEntry& entry : submaps[0]->geometry.blocks().entries()) {
    heaviest = std::max(heaviest, *std::max_element(entry.tsdf->weight.begin(), entry.tsdf->weight.end()));
  }
  EXPECT_FLOAT_EQ(heaviest, 2 * kWeight);
  EXPECT_FALSE(MergeWithInactive(SubmapId(1), MapConfig(), Settings(), submaps));
}

}  // namespace
}  // namespace dhpmap::evaluator

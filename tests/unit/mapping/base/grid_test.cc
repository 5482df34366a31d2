// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/grid.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace dhpmap {
namespace {

TEST(Grid, IndexAndBlockAreInversesForAnySign) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> any(std::numeric_limits<std::int32_t>::min(),
                                                  std::numeric_limits<std::int32_t>::max());
  for (int i = 0; i < 10'000; ++i) {
    VoxelIndex v{any(random), any(random), any(random)};
    if (i % 2 == 0) v = {v.x % 20, v.y % 20, v.z % 20};  // around the origin, where signs go wrong
    const int linear = LinearIndex(v);
    ASSERT_GE(linear, 0);
    ASSERT_LT(linear, kBlockVoxels);
    ASSERT_EQ(VoxelIn(BlockOf(v), linear), v);
  }
}

TEST(Grid, LinearIndexRunsFastestAlongX) {
  EXPECT_EQ(LinearIndex({1, 0, 0}), 1);
  EXPECT_EQ(LinearIndex({0, 1, 0}), kBlockSide);
  EXPECT_EQ(LinearIndex({0, 0, 1}), kBlockSide * kBlockSide);
  EXPECT_EQ(BlockOf({-1, 0, kBlockSide}), (BlockIndex{-1, 0, 1}));
  EXPECT_EQ(LinearIndex({-1, -1, -1}), kBlockVoxels - 1);
}

TEST(Grid, CentreOfAVoxelLiesInItAndCornersBelongToTheUpperVoxel) {
  constexpr double kVoxel_m = 0.04;
  for (int x = -20; x <= 20; ++x) {
    const VoxelIndex v{x, -x, 3 * x};
    EXPECT_EQ(VoxelAt(VoxelCentre(v, kVoxel_m), kVoxel_m), v);
  }
  EXPECT_EQ(VoxelAt({0, 0, 0}, kVoxel_m), (VoxelIndex{0, 0, 0}));
  EXPECT_EQ(VoxelAt({-1e-9, 0.5, -0.5}, 0.25), (VoxelIndex{-1, 2, -2}));
}

TEST(Grid, BlockCornerIsTheLeastCornerOfItsFirstVoxel) {
  const BlockIndex b{-2, 0, 5};
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.02);
  EXPECT_TRUE(BlockCorner(b, 0.04).isApprox(VoxelCentre(VoxelIn(b, 0), 0.04) - half, 1e-12));
}

TEST(BlockIndexHash, SpreadsNeighboursOverLowBits) {
  std::set<std::size_t> slots;
  for (int z = -8; z < 8; ++z) {
    for (int y = -8; y < 8; ++y) {
      for (int x = -8; x < 8; ++x) slots.insert(BlockIndexHash{}({x, y, z}) & 0x1FFF);
    }
  }
  // 4096 keys thrown at random into 8192 slots hit 3223 of them on average.
  EXPECT_GT(slots.size(), 3000u);
}

}  // namespace
}  // namespace dhpmap

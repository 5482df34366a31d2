// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/surface_claims.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace dhpmap {
namespace {

TEST(SurfaceClaims, AreThoseOfObservedVoxelsNearEnoughVoxelByVoxel) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> distance_m(-0.2f, 0.2f);
  constexpr float kMost_m = 0.08f;
  TsdfBlock block;
  for (std::size_t i = 0; i < kBlockVoxels; ++i) {
    block.distance_m[i] = random() % 8 == 0 ? kMost_m : distance_m(random);
    block.weight[i] = random() % 3 == 0 ? 0.0f : random() % 3 == 0 ? kMinObservedWeight : 1.0f;
  }
  for (int i = 0; i < 4; ++i) block.weight[static_cast<std::size_t>(LinearIndex({i, 5, 6}))] = 0;
  SurfaceClaims claims;
  claims.Read(block, kMost_m);
  int count = 0;
  for (std::size_t octant = 0; octant < kLanes; ++octant) {
    std::array<std::uint8_t, kOctantVoxels> found;
    EXPECT_TRUE(claims.Of(octant, found));
    for (int i = 0; i < kOctantVoxels; ++i) {
      const int x = (octant & 1) != 0 ? 4 : 0, y = (octant & 2) != 0 ? 4 : 0, z = (octant & 4) != 0 ? 4 : 0;
      const int linear = LinearIndex({x + (i & 3), y + (i >> 2 & 3), z + (i >> 4)});
      const bool is_claim =
          block.IsObserved(linear) && std::abs(block.distance_m[static_cast<std::size_t>(linear)]) < kMost_m;
      ASSERT_EQ(found[static_cast<std::size_t>(i)], is_claim ? 1 : 0);
      ASSERT_EQ(claims.IsOne(linear), is_claim);
      count += is_claim;
    }
  }
  EXPECT_EQ(claims.Count(), count);
}

TEST(SurfaceClaims, AnOctantWithoutAnySaysSo) {
  TsdfBlock block;
  block.weight[static_cast<std::size_t>(LinearIndex({1, 6, 2}))] = 1;
  SurfaceClaims claims;
  claims.Read(block, 0.1f);
  for (std::size_t octant = 0; octant < kLanes; ++octant) {
    std::array<std::uint8_t, kOctantVoxels> found;
    EXPECT_EQ(claims.Of(octant, found), octant == 2);
  }
}

}  // namespace
}  // namespace dhpmap

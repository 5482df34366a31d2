// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/refinement_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace dhpmap {
namespace {

TEST(RefinementRegion, IsNearWhatItsBlocksAreNear) {
  const std::vector<CubeIndex> cubes = {{0, 0, 0}, {-2, 1, 0}, {3, 0, -1}};
  const RefinementRegion region(cubes);
  std::mt19937 random(1);
  const auto pick = [&random] { return static_cast<std::int32_t>(random() % 60) - 30; };
  int num_near = 0;
  for (int n = 0; n < 3000; ++n) {
    const BlockIndex block{pick(), pick() / 2, pick() / 2};
    const int rim = static_cast<int>(random() % 4);
    bool is_near = false;
    for (const CubeIndex c : cubes) {
      const auto distance = [](std::int32_t at, std::int32_t cube) {
        return std::max({0, cube * kCubeSide - at, at - (cube * kCubeSide + kCubeSide - 1)});
      };
      is_near = is_near || std::max({distance(block.x, c.x), distance(block.y, c.y), distance(block.z, c.z)}) <= rim;
    }
    EXPECT_EQ(region.IsNear(block, rim), is_near);
    EXPECT_EQ(region.IsNear(block, 0), region.Has(CubeOf(block)));
    num_near += is_near;
  }
  EXPECT_GT(num_near, 100);
}

}  // namespace
}  // namespace dhpmap

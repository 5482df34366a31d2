// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace dhpmap {
namespace {

TEST(SpatialOrderTest, CodesInterleaveTheBitsOfTheThreeAxes) {
  EXPECT_EQ(MortonCode({0.0f, 0.0f, 0.0f}), 0u);
  EXPECT_EQ(MortonCode({1.5f / 1024, 0.0f, 0.0f}), 1u);
  EXPECT_EQ(MortonCode({0.0f, 1.5f / 1024, 0.0f}), 2u);
  EXPECT_EQ(MortonCode({0.0f, 0.0f, 1.5f / 1024}), 4u);
  EXPECT_EQ(MortonCode({2.5f / 1024, 3.5f / 1024, 0.0f}), 8u + 16u + 2u);
  EXPECT_EQ(MortonCode({1.0f, 1.0f, 1.0f}), (1u << 30) - 1);
}

TEST(SpatialOrderTest, CodesOfPointsOutsideStayInRange) {
  EXPECT_EQ(MortonCode({-5.0f, 0.0f, std::numeric_limits<float>::quiet_NaN()}), 0u);
  EXPECT_EQ(MortonCode(Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity())), (1u << 30) - 1);
}

TEST(SpatialOrderTest, SortsStablyOnAnyNumberOfThreads) {
  std::mt19937 random(1);
  for (const std::size_t size : {0u, 1u, 1000u, 200000u}) {
    std::vector<std::uint32_t> codes(size), expected(size);
    // Many codes come up twice.
    for (std::uint32_t& code : codes) code = random() % 2 == 0 ? random() % 50 : random() % (1u << 30);
    std::iota(expected.begin(), expected.end(), 0u);
    std::stable_sort(expected.begin(), expected.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return codes[a] < codes[b]; });
    for (const int num_threads : {1, 3}) {
      ThreadPool pool(num_threads);
      GrowBuffer<std::uint32_t> scratch, order;
      scratch.Resize(size);
      std::copy(codes.begin(), codes.end(), scratch.begin());
      SortByCode(scratch, order, pool);
      EXPECT_EQ(std::vector<std::uint32_t>(order.begin(), order.end()), expected);
    }
  }
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/camera_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace dhpmap {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The limit of 2 x 2 depths on the optical axis: margin 0.1 m, range 5 m, voxels of 0.1 m.
float LimitOf(float a, float b, float c, float d) {
  const float upper[] = {a, b}, lower[] = {c, d}, column = 0;
  float limit = -1;
  LimitRow(upper, lower, 1, {&column, 1.0f, 0.1f, 5.0f, 10.0f}, &limit);
  return limit;
}

TEST(LimitRow, TakesTheLeastOfThreeOrFourReturns) {
  EXPECT_FLOAT_EQ(LimitOf(2, 3, 4, 1.5f), 14);
  EXPECT_FLOAT_EQ(LimitOf(2, 3, 0, 4), 19);
  EXPECT_FLOAT_EQ(LimitOf(kNan, 3, 4, 2), 19);
  EXPECT_EQ(LimitOf(2, 0, 0, 4), kNoLimit);
  EXPECT_EQ(LimitOf(kNoLimit, -1, 2, 4), kNoLimit);
  EXPECT_EQ(LimitOf(kNan, kNan, kNan, kNan), kNoLimit);
  EXPECT_FLOAT_EQ(LimitOf(9, 9, 9, 9), 50) << "up to the range";
  EXPECT_EQ(LimitOf(0.05f, 9, 9, 9), 0) << "a return all the same";
}

TEST(LimitRow, MarginAndRangeAreAlongTheRay) {
  const float depth[] = {4, 4, 4, 4}, columns[] = {0.0f, 3.0f};  // the second ray is 2 long for unit depth
  float limit[2];
  LimitRow(depth, depth, 2, {columns, 1.0f, 0.1f, 5.0f, 1.0f}, limit);
  EXPECT_FLOAT_EQ(limit[0], 3.9f);
  EXPECT_FLOAT_EQ(limit[1], 2.5f) << "5 m of range";
}

TEST(CloseRow, FillsAHoleWithTheLeastOfFourNeighboursOrMore) {
  std::mt19937 random(5);
  constexpr int kWidth = 37;
  for (int round = 0; round < 200; ++round) {
    std::vector<std::vector<float>> rows(3, std::vector<float>(kWidth + 2, kNoLimit));
    for (auto& row : rows) {
      for (int u = 1; u <= kWidth; ++u) {
        if (random() % 2 == 0) row[static_cast<std::size_t>(u)] = static_cast<float>(random() % 50);
      }
    }
    std::vector<float> least(kWidth + 2), count(kWidth + 2), closed(kWidth);
    CloseRow(rows[0].data(), rows[1].data(), rows[2].data(), kWidth, least.data(), count.data(), closed.data());
    for (std::size_t u = 0; u < kWidth; ++u) {
      std::vector<float> around;
      for (const auto& row : rows)
        std::copy_n(row.begin() + static_cast<std::ptrdiff_t>(u), 3, std::back_inserter(around));
      std::erase(around, kNoLimit);
      const float own = rows[1][u + 1];
      const float filled = around.size() >= 4 ? *std::min_element(around.begin(), around.end()) : 0;
      EXPECT_EQ(closed[u], own < kNoLimit ? own : filled);
    }
  }
}

}  // namespace
}  // namespace dhpmap

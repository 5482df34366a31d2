// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/crf/float8.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dhpmap {
namespace {

TEST(Float8Test, ExponentialsAreExactToTwoUnitsInTheLastPlace) {
  for (float begin = -86.9f; begin <= 0.0f; begin += 0.013f) {
    Float8 x;
    for (int i = 0; i < 8; ++i)
      x[i] = begin - 0.001f * static_cast<float>(i) > -87.0f ? begin - 0.001f * static_cast<float>(i) : 0;
    Float8 y = x;
    ExpOfNegative(y);
    for (int i = 0; i < 8; ++i) {
      const double exact = std::exp(static_cast<double>(x[i]));
      ASSERT_NEAR(y[i], exact, 2.4e-7 * exact) << x[i];
    }
  }
}

TEST(Float8Test, ExponentialsOfExtremesAreZeroAndOne) {
  Float8 x = {0.0f, -0.0f, -std::numeric_limits<float>::infinity(), -88.0f, -1e30f, -87.0f, -1e-30f, -1e-8f};
  ExpOfNegative(x);
  const float expected[] = {1, 1, 0, 0, 0, 0, 1, 1};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(x[i], expected[i]) << i;
}

TEST(Float8Test, GreatestAndSumReachAllElements) {
  Float8 most = {3, 1, 4, 1, 5, 9, 2, 6}, sum = most;
  SpreadMax(most);
  SpreadSum(sum);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(most[i], 9.0f);
    EXPECT_EQ(sum[i], 31.0f);
  }
}

}  // namespace
}  // namespace dhpmap

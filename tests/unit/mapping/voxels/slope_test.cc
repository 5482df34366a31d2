// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/slope.h"

#include <gtest/gtest.h>

#include <limits>

namespace dhpmap {
namespace {

constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();

TEST(Slope, IsCentralWhereBothNeighboursAreObserved) { EXPECT_FLOAT_EQ(Slope(1, 7, 5), 2); }

TEST(Slope, IsOneSidedWhereOneNeighbourIsObserved) {
  EXPECT_FLOAT_EQ(Slope(kUnseen, 2, 5), 3);
  EXPECT_FLOAT_EQ(Slope(1, 2, kUnseen), 1);
}

TEST(Slope, IsZeroWhereNoNeighbourIsObserved) { EXPECT_EQ(Slope(kUnseen, 2, kUnseen), 0); }

}  // namespace
}  // namespace dhpmap

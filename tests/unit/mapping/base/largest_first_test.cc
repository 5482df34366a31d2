// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/largest_first.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

TEST(LargestFirst, OrdersBySizeAndKeepsEqualOnesInTheirOrder) {
  const std::vector<std::size_t> sizes = {3, 0, 7, 3, 7, 1};
  EXPECT_EQ(LargestFirst(sizes), (std::vector<std::size_t>{2, 4, 0, 3, 5, 1}));
  EXPECT_TRUE(LargestFirst({}).empty());
}

}  // namespace
}  // namespace dhpmap

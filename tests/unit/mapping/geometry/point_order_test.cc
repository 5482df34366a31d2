// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/geometry/point_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/unit/mapping/query/surface_scene.h"

namespace dhpmap {
namespace {

bool IsPermutation(std::vector<std::uint32_t> order, std::size_t count) {
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    if (order[i] != i) return false;
  }
  return order.size() == count;
}

TEST(OrderAlongCurve, TakesEveryPointOnceAndGoesShortWays) {
  const auto points = testing::RandomPoints(5000, 3, 1);
  const auto order = OrderAlongCurve(points);
  ASSERT_TRUE(IsPermutation(order, points.size()));
  double as_given_m = 0, along_m = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    as_given_m += (points[i] - points[i - 1]).norm();
    along_m += (points[order[i]] - points[order[i - 1]]).norm();
  }
  EXPECT_LT(along_m, as_given_m / 5);
}

TEST(OrderAlongCurve, TakesPointsAsTheyCome) {
  EXPECT_TRUE(OrderAlongCurve({}).empty());
  const std::vector<Eigen::Vector3d> same(100, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(IsPermutation(OrderAlongCurve(same), same.size()));
  constexpr double kHuge = std::numeric_limits<double>::max();
  const std::vector<Eigen::Vector3d> far = {{kHuge, 0, 0}, {-kHuge, kHuge, -kHuge}, {0, 0, 0}};
  EXPECT_TRUE(IsPermutation(OrderAlongCurve(far), far.size()));
}

}  // namespace
}  // namespace dhpmap

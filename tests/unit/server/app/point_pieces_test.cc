// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/point_pieces.h"

#include <gtest/gtest.h>

#include <random>

namespace dhpmap {
namespace {

std::vector<Eigen::Vector3d> RandomPlaces(std::size_t number) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-5, 5);
  std::vector<Eigen::Vector3d> points_m(number);
  for (Eigen::Vector3d& p : points_m) p = {anywhere(random), anywhere(random), anywhere(random)};
  return points_m;
}

TEST(PointPieces, BatchesContainAllPointsInOrderWithSimilarSizes) {
  for (const std::size_t number : {1u, 8192u, 8193u, 10'000u, 50'000u}) {
    const auto points_m = RandomPlaces(number);
    const Eigen::Vector3d* next = points_m.data();
    std::size_t least = number, most = 0;
    for (const auto batch : BatchesOf(points_m)) {
      EXPECT_EQ(batch.data(), next);
      next += batch.size();
      least = std::min(least, batch.size());
      most = std::max(most, batch.size());
    }
    EXPECT_EQ(next, points_m.data() + number);
    EXPECT_LE(most, 8192u);
    EXPECT_LE(most, least + 1);
  }
  EXPECT_TRUE(BatchesOf({}).empty());
}

TEST(PointPieces, EachPointBelongsToOneCompactPiece) {
  const auto points_m = RandomPlaces(8000);
  std::vector<int> times(points_m.size(), 0);
  const Spread backwards = [](std::size_t count, const std::function<void(std::size_t)>& body) {
    while (count > 0) body(--count);
  };
  SpreadAlongCurve(points_m, backwards, [&](std::span<const std::uint32_t> piece) {
    Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
    for (const std::uint32_t i : piece) {
      ++times[i];
      middle_m += points_m[i] / static_cast<double>(piece.size());
    }
    double mean_m = 0;  // 4.8 m from the middle of all
    for (const std::uint32_t i : piece) mean_m += (points_m[i] - middle_m).norm() / static_cast<double>(piece.size());
    EXPECT_LT(mean_m, 4);
  });
  EXPECT_EQ(times, std::vector<int>(points_m.size(), 1));
}

}  // namespace
}  // namespace dhpmap

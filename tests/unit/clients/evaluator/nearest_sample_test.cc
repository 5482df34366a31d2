// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/nearest_sample.h"

#include <gtest/gtest.h>

#include <random>

namespace dhpmap::evaluator {
namespace {

std::vector<Eigen::Vector3f> RandomPoints(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) points.push_back({coordinate(random), coordinate(random), coordinate(random)});
  return points;
}

TEST(NearestSample, AgreesWithLookingAtAll) {
  const auto points = RandomPoints(500, 1), queries = RandomPoints(300, 2);
  const NearestSample nearest(points);
  constexpr double kReach_m = 0.2;
  int num_without = 0;
  for (const auto& q : queries) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 1; i < points.size(); ++i) {
      if ((points[i] - q).squaredNorm() < (points[best] - q).squaredNorm()) best = i;
    }
    const float distance_m = (points[best] - q).norm();
    const Neighbour found = nearest.Find(q, kReach_m);
    ASSERT_EQ(found.exists(), distance_m <= kReach_m);
    num_without += found.exists() ? 0 : 1;
    if (!found.exists()) continue;
    EXPECT_EQ(found.index, best);
    EXPECT_NEAR(found.distance_m, distance_m, 1e-6);
  }
  EXPECT_GT(num_without, 0) << "the reach was never tried";
}

TEST(NearestSample, TakesTheFirstOfEquallyNearPoints) {
  std::vector<Eigen::Vector3f> points(200, Eigen::Vector3f(5, 5, 5));
  for (const std::size_t i : {40, 90, 150}) points[i] = {1, 0, 0};
  for (const std::size_t i : {30, 100}) points[i] = {-1, 0, 0};
  EXPECT_EQ(NearestSample(points).Find({0, 0, 0}, 2).index, 30u);
  EXPECT_EQ(NearestSample(points).Find({0.5f, 0, 0}, 2).index, 40u);
}

TEST(NearestSample, ReachesAsFarAsItIsAskedTo) {
  const std::vector<Eigen::Vector3f> points{{0.5f, 0, 0}};
  EXPECT_TRUE(NearestSample(points).Find({0, 0, 0}, 0.5).exists());
  EXPECT_FALSE(NearestSample(points).Find({0, 0, 0}, 0.499).exists());
}

TEST(NearestSample, FindsTheSameOnAnyNumberOfThreads) {
  const auto points = RandomPoints(2000, 3), queries = RandomPoints(9000, 4);
  const NearestSample nearest(points);
  ThreadPool one(1), four(4);
  const auto a = nearest.FindAll(queries, 0.1, one), b = nearest.FindAll(queries, 0.1, four);
  ASSERT_EQ(a.size(), queries.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].index, b[i].index);
}

TEST(NearestSample, OfNoPointsIsNone) {
  const std::vector<Eigen::Vector3f> none;
  EXPECT_FALSE(NearestSample(none).Find({0, 0, 0}, 10).exists());
}

}  // namespace
}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/triangle_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dhpmap::evaluator {
namespace {

TEST(DistanceToTriangle, AgreesWithTryingManyPoints) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  const auto point = [&] { return Eigen::Vector3f{coordinate(random), coordinate(random), coordinate(random)}; };
  for (int n = 0; n < 200; ++n) {
    const Eigen::Vector3f a = point(), b = point(), c = point(), p = 2 * point();
    float best_m = 1e9f;
    constexpr int kSteps = 60;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const float u = static_cast<float>(i) / kSteps, v = static_cast<float>(j) / kSteps;
        best_m = std::min(best_m, (a + u * (b - a) + v * (c - a) - p).norm());
      }
    }
    EXPECT_NEAR(DistanceToTriangle(p, a, b, c), best_m, 0.03);
    EXPECT_LE(DistanceToTriangle(p, a, b, c), best_m + 1e-5f);
  }
}

TEST(DistanceToTriangle, TakesATriangleWithoutAreaForALine) {
  EXPECT_FLOAT_EQ(DistanceToTriangle({0, 1, 0}, {-1, 0, 0}, {0, 0, 0}, {1, 0, 0}), 1);
  EXPECT_FLOAT_EQ(DistanceToTriangle({0, 1, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}), 1);
}

TEST(MeasureToTriangles, DoesNotSeeTheSpacingOfSamples) {
  Mesh plane;
  constexpr std::uint32_t kSide = 20;
  for (std::uint32_t y = 0; y <= kSide; ++y) {
    for (std::uint32_t x = 0; x <= kSide; ++x) {
      plane.vertices_m.emplace_back(0.05f * static_cast<float>(x), 0.05f * static_cast<float>(y), 0.0f);
      const std::uint32_t v = y * (kSide + 1) + x;
      if (x == kSide || y == kSide) continue;
      plane.triangles.push_back({v, v + 1, v + kSide + 2});
      plane.triangles.push_back({v, v + kSide + 2, v + kSide + 1});
    }
  }
  plane.classes.assign(plane.vertices_m.size(), 1);
  plane.instances.assign(plane.vertices_m.size(), 1);
  const SurfaceSamples samples = SampleSurface(plane, 0.02);
  std::vector<Eigen::Vector3f> queries;
  std::mt19937 random(6);
  std::uniform_real_distribution<float> coordinate(0, 1);
  for (int i = 0; i < 2000; ++i) queries.push_back({coordinate(random), coordinate(random), 0.013f});
  ThreadPool here(1);
  std::vector<Neighbour> neighbours = NearestSample(samples.positions_m).FindAll(queries, 1, here);
  const auto mean_m = [&neighbours] {
    double sum_m = 0;
    for (const Neighbour& n : neighbours) sum_m += n.distance_m;
    return sum_m / static_cast<double>(neighbours.size());
  };
  EXPECT_GT(mean_m(), 0.015);
  MeasureToTriangles(queries, plane, samples, neighbours);
  EXPECT_NEAR(mean_m(), 0.013, 0.0005);
}

}  // namespace
}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/surface_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dhpmap::evaluator {
namespace {

/// A square of side 1 m in so many strips, the left edge class 1 instance 5, the right one class 2 instance 6.
Mesh Square(int num_strips) {
  Mesh mesh;
  for (int i = 0; i <= num_strips; ++i) {
    const float y = static_cast<float>(i) / static_cast<float>(num_strips);
    mesh.vertices_m.insert(mesh.vertices_m.end(), {{0, y, 0}, {1, y, 0}});
    mesh.classes.insert(mesh.classes.end(), {1, 2});
    mesh.instances.insert(mesh.instances.end(), {5, 6});
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(num_strips); ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 2});
    mesh.triangles.push_back({2 * i + 1, 2 * i + 3, 2 * i + 2});
  }
  return mesh;
}

TEST(SurfaceSamples, AreAsManyAsTheAreaSaysHoweverItIsCut) {
  for (const int num_strips : {1, 7, 400}) {
    EXPECT_NEAR(static_cast<double>(SampleSurface(Square(num_strips), 0.01).size()), 10000, 2) << num_strips;
  }
}

TEST(SurfaceSamples, SpreadEvenly) {
  std::array<int, 100> counts{};
  for (const auto& p : SampleSurface(Square(5), 0.01).positions_m) {
    ASSERT_GE(p.minCoeff(), 0);
    ASSERT_LE(p.maxCoeff(), 1);
    ++counts[static_cast<std::size_t>(std::min(9, static_cast<int>(p.x() * 10)) +
                                      10 * std::min(9, static_cast<int>(p.y() * 10)))];
  }
  EXPECT_GE(*std::min_element(counts.begin(), counts.end()), 75);
  EXPECT_LE(*std::max_element(counts.begin(), counts.end()), 125);
}

TEST(SurfaceSamples, TakeTheLabelOfTheNearestCorner) {
  const SurfaceSamples samples = SampleSurface(Square(100), 0.02);
  int num_wrong = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool is_left = samples.positions_m[i].x() < 0.5f;
    if (std::abs(samples.positions_m[i].x() - 0.5f) < 0.001f) continue;
    num_wrong += samples.classes[i] != (is_left ? 1 : 2) || samples.instances[i] != (is_left ? 5u : 6u) ? 1 : 0;
  }
  EXPECT_EQ(num_wrong, 0);
}

TEST(SurfaceSamples, AreTheSameEachTime) {
  EXPECT_EQ(SampleSurface(Square(3), 0.05).positions_m, SampleSurface(Square(3), 0.05).positions_m);
}

TEST(SurfaceSamples, OfNothingAreNone) { EXPECT_EQ(SampleSurface({}, 0.01).size(), 0u); }

}  // namespace
}  // namespace dhpmap::evaluator

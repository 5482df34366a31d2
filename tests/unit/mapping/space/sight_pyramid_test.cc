// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/sight_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace dhpmap {
namespace {

SightImage RandomImage(int width, int height, std::mt19937& random) {
  SightImage image{width, height, {}};
  std::uniform_real_distribution<float> limit(0.0f, 100.0f);
  for (int i = 0; i < width * height; ++i) image.limit_vox.push_back(limit(random));
  return image;
}

SightPyramid::Span Naive(const SightImage& image, int u0, int v0, int u1, int v1) {
  SightPyramid::Span span{std::numeric_limits<float>::infinity(), 0};
  for (int v = std::max(0, v0); v <= std::min(v1, image.height - 1); ++v) {
    for (int u = std::max(0, u0); u <= std::min(u1, image.width - 1); ++u) {
      const float limit = image.limit_vox[static_cast<std::size_t>(v * image.width + u)];
      span = {std::min(span.least, limit), std::max(span.most, limit)};
    }
  }
  return span;
}

TEST(SightPyramid, BoundsAnyRectangleByItsPixelsAndAtMostSoManyAroundIt) {
  std::mt19937 random(3);
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 7}, {5, 5}, {33, 17}, {64, 64}, {320, 3}}) {
    const SightImage image = RandomImage(width, height, random);
    SightPyramid pyramid;
    pyramid.Build(RandomImage(100, 100, random));  // what was built before leaves no trace
    pyramid.Build(image);
    EXPECT_EQ(pyramid.most(), Naive(image, 0, 0, width, height).most);
    for (int i = 0; i < 2000; ++i) {
      const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
      const int u0 = below(width), v0 = below(height), u1 = u0 + below(width - u0), v1 = v0 + below(height - v0);
      const SightPyramid::Span span = pyramid.Over(u0, v0, u1, v1);
      const SightPyramid::Span inside = Naive(image, u0, v0, u1, v1);
      const int around = 3 + 2 * std::max(u1 - u0, v1 - v0);
      const SightPyramid::Span beyond = Naive(image, u0 - around, v0 - around, u1 + around, v1 + around);
      ASSERT_LE(span.least, inside.least);
      ASSERT_GE(span.most, inside.most);
      ASSERT_GE(span.least, beyond.least);
      ASSERT_LE(span.most, beyond.most);
    }
  }
}

TEST(SightPyramid, OfNoPixelsHasNoLimit) {
  SightPyramid pyramid;
  pyramid.Build({});
  EXPECT_EQ(pyramid.most(), 0);
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/point_kernel.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace dhpmap {
namespace {

/// A row of few voxels and segments, so that neighbours are often alike, with gaps.
struct Row {
  std::vector<float> weight;
  std::vector<std::int32_t> x, y, z;
  std::vector<std::uint32_t> segments;

  Row(std::size_t width, std::mt19937& random) {
    const auto one_of = [&random](unsigned count) { return random() % count; };
    for (std::size_t u = 0; u < width; ++u) {
      weight.push_back(one_of(8) == 0 ? 0.0f : 0.25f);
      x.push_back(one_of(6) == 0 ? 1 : 0);
      y.push_back(one_of(6) == 0 ? 1 : 0);
      z.push_back(one_of(6) == 0 ? -1 : 0);
      segments.push_back(one_of(6) == 0 ? 7 : 3);
    }
  }
  [[nodiscard]] RowPoints Points() { return {nullptr, nullptr, nullptr, weight.data(), x.data(), y.data(), z.data()}; }
  [[nodiscard]] bool GoesOn(std::size_t u, bool by_segment) const {
    if (u == 0 || u == weight.size() || weight[u] == 0 || weight[u - 1] == 0) return false;
    if (by_segment && segments[u] != segments[u - 1]) return false;
    return x[u] == x[u - 1] && y[u] == y[u - 1] && z[u] == z[u - 1];
  }
};

TEST(PointKernel, ARunGoesOnWhereThereIsAPointInTheSameVoxelAndSegment) {
  std::mt19937 random(11);
  for (const std::size_t width : {1u, 2u, 15u, 16u, 17u, 64u, 333u}) {
    for (const bool by_segment : {false, true}) {
      Row row(width, random);
      std::vector<std::uint8_t> goes_on(width + 1, 9);
      MarkRuns(row.Points(), by_segment ? row.segments.data() : nullptr, static_cast<int>(width), goes_on.data());
      for (std::size_t u = 0; u <= width; ++u) {
        ASSERT_EQ(goes_on[u] != 0, row.GoesOn(u, by_segment)) << u << " of " << width;
      }
    }
  }
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/point_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

namespace dhpmap {
namespace {

/// A row of a camera that looks along z, with room for its points.
struct Row {
  std::vector<float> depth_m, column_x, zero, length2, weighted_m, colors;
  std::vector<std::uint32_t> segments, numbers;
  std::vector<PointPlace> places;
  RowGeometry geometry{};

  explicit Row(std::size_t width)
      : depth_m(width, 1.5f),
        zero(width, 0.0f),
        weighted_m(4 * width, -7.0f),
        colors(4 * width, -7.0f),
        segments(width, 3),
        numbers(width, 9),
        places(width) {
    for (std::size_t u = 0; u < width; ++u) {
      column_x.push_back(0.01f * static_cast<float>(u) - 1.0f);
      length2.push_back(1.0f + column_x[u] * column_x[u]);
    }
    geometry.column_x = column_x.data(), geometry.column_y = geometry.column_z = zero.data();
    geometry.column_length2 = length2.data();
    geometry.row_y = 0.5f, geometry.row_z = 1.0f, geometry.row_length2 = 0.25f;
    geometry.offset_x_vox = 0.25f, geometry.offset_y_vox = 0.5f, geometry.offset_z_vox = 0.75f;
    geometry.base_x = -4, geometry.base_y = 7, geometry.base_z = 1000;
    geometry.voxels_per_m = 8.0f;
    geometry.min_range2_m2 = 0.01f, geometry.max_range2_m2 = 25.0f;
  }
  void Project() {
    ProjectRow(depth_m.data(), segments.data(), static_cast<int>(depth_m.size()), geometry,
               {weighted_m.data(), places.data()->words.data(), numbers.data()});
  }
  [[nodiscard]] std::int32_t VoxelX(std::size_t u) const {
    return static_cast<std::int32_t>(std::floor(depth_m[u] * column_x[u] * 8.0f + 0.25f)) - 4;
  }
};

TEST(PointKernel, PutsEachPixelWhereItsRayEnds) {
  for (const std::size_t width : {1u, 2u, 15u, 16u, 17u, 64u, 333u}) {
    Row row(width);
    for (std::size_t u = 0; u < width; ++u) row.segments[u] = static_cast<std::uint32_t>(u / 3) + 4'000'000'000u;
    row.Project();
    for (std::size_t u = 0; u < width; ++u) {
      const PointPlace& place = row.places[u];
      ASSERT_EQ(place, PointPlace(row.segments[u], {row.VoxelX(u), 13, 1012})) << u << " of " << width;
      ASSERT_EQ(place.segment(), row.segments[u]);
      ASSERT_EQ(place.voxel(), (VoxelIndex{row.VoxelX(u), 13, 1012}));
      ASSERT_EQ(row.numbers[u], PlaceNumber(place.words[0], place.words[1], place.words[2], place.words[3]));
      ASSERT_LT(row.numbers[u], 1u << kPlaceBits);
      ASSERT_EQ(row.weighted_m[4 * u], 1.0f);
      ASSERT_EQ(row.weighted_m[4 * u + 1], 1.5f * row.column_x[u]);
      ASSERT_EQ(row.weighted_m[4 * u + 3], 1.5f);
    }
  }
}

TEST(PointKernel, PixelsWithoutAPointWeighNothingAndHaveNoNumber) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const Weighting weighting :
       {Weighting::kConstant, Weighting::kInverseDepthSquared, Weighting::kInverseRangeSquared}) {
    Row row(40);
    row.geometry.weighting = weighting;
    const std::vector<float> none = {0.0f, -1.0f, nan, inf, -inf, 5.1f, 0.05f, -0.0f};
    for (std::size_t i = 0; i < none.size(); ++i) row.depth_m[5 * i] = none[i];
    row.Project();
    for (std::size_t u = 0; u < 40; ++u) {
      const bool has_point = u % 5 != 0;
      EXPECT_EQ(row.numbers[u] != RowPoints::kNoPoint, has_point) << u;
      EXPECT_EQ(row.weighted_m[4 * u] > 0, has_point) << u;
    }
  }
}

TEST(PointKernel, ColoursAreWeighedAndPointsCounted) {
  Row row(37);
  std::vector<Color> given;
  for (std::size_t u = 0; u < 37; ++u) {
    row.weighted_m[4 * u] = 0.25f * static_cast<float>(u);
    given.push_back({static_cast<std::uint8_t>(u), static_cast<std::uint8_t>(255 - u), 7});
  }
  for (const bool has_color : {true, false}) {
    WeighColors(has_color ? given.data() : nullptr, row.weighted_m.data(), 37, row.colors.data());
    for (std::size_t u = 0; u < 37; ++u) {
      const Color color = has_color ? given[u] : Color{kNoColor, kNoColor, kNoColor};
      const float w = row.weighted_m[4 * u];
      EXPECT_EQ(row.colors[4 * u], w * static_cast<float>(color.r));
      EXPECT_EQ(row.colors[4 * u + 1], w * static_cast<float>(color.g));
      EXPECT_EQ(row.colors[4 * u + 2], w * static_cast<float>(color.b));
      EXPECT_EQ(row.colors[4 * u + 3], 1.0f);
    }
  }
}

TEST(PointKernel, FewPlacesOfANeighbourhoodShareANumber) {
  std::set<std::uint32_t> numbers;
  for (std::int32_t x = -8; x < 8; ++x) {
    for (std::int32_t y = 100; y < 108; ++y) {
      for (std::int32_t z = -2; z < 2; ++z) numbers.insert(PlaceNumber(1, x, y, z));
    }
  }
  EXPECT_GT(numbers.size(), 430u) << "of 512; drawn at random, 481 would be expected to differ";
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/moment_pyramid.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace dhpmap {
namespace {

/// A row of blocks with a bundle in every voxel.
SegmentBundles FullBlocks(int count) {
  SegmentBundles segment;
  for (int i = 0; i < count; ++i) {
    segment.cells.push_back({.block = {i, 0, 0},
                             .first_bundle = static_cast<std::uint32_t>(segment.bundles.size()),
                             .num_bundles = kBlockVoxels});
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      Bundle bundle;
      bundle.weight = 1;
      bundle.weighted_sum_m = Eigen::Vector3f(static_cast<float>(i), static_cast<float>(linear), 1);
      bundle.linear = static_cast<std::uint16_t>(linear);
      segment.bundles.push_back(bundle);
    }
  }
  return segment;
}

TEST(MomentPyramid, EachLevelHasAllBundlesOfItsCubes) {
  const SegmentBundles segment = FullBlocks(2);
  MomentPyramid pyramid;
  pyramid.Build(segment);
  for (int level = 1; level <= MomentPyramid::kNumLevels; ++level) {
    const int num_a_side = kBlockSide >> level, side = 1 << level;
    double count = 0, sum_y = 0;
    for (int cube = 0; cube < num_a_side * num_a_side * num_a_side; ++cube) {
      const PlaneMoments* moments = pyramid.Find(1, level, static_cast<std::size_t>(cube));
      ASSERT_NE(moments, nullptr);
      EXPECT_EQ(moments->num_bundles(), side * side * side);
      count += moments->num_bundles();
      sum_y += moments->sums[2];
    }
    EXPECT_EQ(count, kBlockVoxels);
    EXPECT_EQ(sum_y, kBlockVoxels * (kBlockVoxels - 1) / 2.0);
  }
}

TEST(MomentPyramid, WhatWasFoundStaysWhileMoreIsSummedUp) {
  const SegmentBundles segment = FullBlocks(40);
  MomentPyramid pyramid;
  pyramid.Build(segment);
  std::vector<const PlaneMoments*> found;
  for (std::size_t cell = 0; cell < segment.cells.size(); ++cell) found.push_back(pyramid.Find(cell, 2, 7));
  for (std::size_t cell = 0; cell < segment.cells.size(); ++cell) {
    EXPECT_EQ(pyramid.Find(cell, 2, 7), found[cell]);
    EXPECT_EQ(found[cell]->sums[1], 64.0 * static_cast<double>(cell));
  }
}

TEST(MomentPyramid, OfTheNextSegmentHoldsNothingOfTheLast) {
  MomentPyramid pyramid;
  pyramid.Build(FullBlocks(3));
  for (int level = 1; level <= MomentPyramid::kNumLevels; ++level) ASSERT_NE(pyramid.Find(2, level, 0), nullptr);
  const std::size_t kept_bytes = pyramid.BufferBytes();

  SegmentBundles one = FullBlocks(1);
  one.cells[0].num_bundles = 1;  // in the first voxel
  one.bundles.resize(1);
  pyramid.Build(one);
  for (int level = 1; level <= MomentPyramid::kNumLevels; ++level) {
    ASSERT_NE(pyramid.Find(0, level, 0), nullptr);
    EXPECT_EQ(pyramid.Find(0, level, 0)->num_bundles(), 1);
  }
  for (int level = 1; level < MomentPyramid::kNumLevels; ++level) EXPECT_EQ(pyramid.Find(0, level, 1), nullptr);
  EXPECT_EQ(pyramid.BufferBytes(), kept_bytes) << "it keeps its memory";
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/fusion/segment_bundles.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>

namespace dhpmap {
namespace {

TEST(SegmentBundles, FindsEveryBlockThatWasPutInAndNoOther) {
  SegmentBundles segment;
  EXPECT_EQ(segment.Find({0, 0, 0}), nullptr);
  EXPECT_FALSE(segment.EndsIn({0, 0, 0}));
  std::mt19937 random(3);
  std::set<BlockIndex> blocks;
  for (int i = 0; i < 3000; ++i) {
    const auto coordinate = [&random] { return static_cast<std::int32_t>(random() % 20) - 10; };
    const BlockIndex block{coordinate(), coordinate(), coordinate()};
    EXPECT_EQ(segment.FindOrInsert(block).block, block);
    blocks.insert(block);
    ASSERT_EQ(segment.cells.size(), blocks.size());
  }
  for (std::int32_t x = -11; x <= 10; ++x) {
    for (std::int32_t y = -11; y <= 10; ++y) {
      for (std::int32_t z = -11; z <= 10; ++z) {
        const BundleCell* cell = segment.Find({x, y, z});
        ASSERT_EQ(cell != nullptr, blocks.count({x, y, z}) == 1);
        if (cell == nullptr) continue;
        ASSERT_EQ(cell->block, (BlockIndex{x, y, z}));
      }
    }
  }
}

TEST(SegmentBundles, NumberTheBundlesOfACellByTheirVoxels) {
  std::mt19937 random(8);
  BundleCell cell, counted;
  cell.first_bundle = counted.first_bundle = 50;
  std::set<int> ends;
  for (int n = 0; n < 200; ++n) {
    const int linear = static_cast<int>(random() % kBlockVoxels);
    if (!ends.insert(linear).second) continue;
    cell.AddBundle(linear);
    SetIn(counted.ends, linear, true);
  }
  counted.CountBundles();
  EXPECT_EQ(cell.num_bundles, ends.size());
  EXPECT_EQ(counted.num_bundles, ends.size());
  std::uint32_t number = 50;
  for (const int linear : ends) {
    EXPECT_EQ(cell.BundleAt(linear), number);
    EXPECT_EQ(counted.BundleAt(linear), number++);
  }
}

TEST(SegmentBundles, HaveNothingInThemAfterAResetAndCanBeFilledAgain) {
  SegmentBundles segment;
  segment.row = 3;
  for (std::int32_t x = 0; x < 100; ++x) segment.FindOrInsert({x, 0, 0});
  const std::size_t bytes = segment.BufferBytes();
  segment.Reset();
  EXPECT_EQ(segment.row, -1);
  EXPECT_EQ(segment.Find({7, 0, 0}), nullptr);
  for (std::int32_t x = 0; x < 100; ++x) segment.FindOrInsert({x, 5, 0});
  EXPECT_EQ(segment.cells.size(), 100u);
  EXPECT_EQ(segment.BufferBytes(), bytes) << "it kept its memory";
}

}  // namespace
}  // namespace dhpmap

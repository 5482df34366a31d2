// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/gone_block.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

#include "mapping/map/map.h"
#include "tests/support/diff_snapshots.h"

namespace dhpmap {
namespace {

Viewpoint From(double x_m, std::int64_t stamp_ns = 0) { return {{x_m, 0, 0}, stamp_ns}; }

TEST(GoneBlock, CountsToThreeAndStays) {
  std::mt19937 random(1);
  GoneBlock block;
  std::array<int, kBlockVoxels> expected{};
  for (int round = 0; round < 200; ++round) {
    VoxelMask voxels{};
    int num_became = 0;
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      if (random() % 8 != 0) continue;
      voxels[static_cast<std::size_t>(linear / 64)] |= std::uint64_t{1} << linear % 64;
      int& count = expected[static_cast<std::size_t>(linear)];
      num_became += count == 2;
      count = std::min(count + 1, 3);
    }
    EXPECT_EQ(block.Raise(voxels, From(round)), num_became);
    for (int n = 0; n < 20; ++n) {
      const int linear = static_cast<int>(random() % kBlockVoxels);
      block.Forget(linear);
      expected[static_cast<std::size_t>(linear)] = 0;
    }
    const VoxelMask contradicted = block.Contradicted();
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      const int count = expected[static_cast<std::size_t>(linear)];
      ASSERT_EQ(block.Count(linear), count);
      ASSERT_EQ(block.IsContradicted(linear), count == 3);
      ASSERT_EQ((contradicted[static_cast<std::size_t>(linear / 64)] >> linear % 64 & 1u) != 0, count == 3);
    }
  }
  for (int linear = 0; linear < kBlockVoxels; ++linear) block.Forget(linear);
  EXPECT_TRUE(block.empty());
}

TEST(GoneBlock, AViewCountsIfItIsATenthOfAMetreOrASecondFromTheLast) {
  GoneBlock block;
  EXPECT_TRUE(block.IsDistinct(From(0))) << "the first one does";
  block.Raise({1}, From(0, 0));
  EXPECT_FALSE(block.IsDistinct(From(0.09, 999'999'999)));
  EXPECT_TRUE(block.IsDistinct(From(0.11)));
  EXPECT_TRUE(block.IsDistinct(From(0, 1'000'000'000)));
  EXPECT_TRUE(block.IsDistinct(From(0, -1'000'000'000)));
  block.Raise({1}, From(0, std::numeric_limits<std::int64_t>::min()));
  EXPECT_TRUE(block.IsDistinct(From(0, std::numeric_limits<std::int64_t>::max())));
}

constexpr BlockIndex kBlock{1, 0, 0};

Submap& AddSubmap(Map& map) {
  SubmapInfo info;
  info.voxel_size_m = 0.04;
  Submap& submap = map.Create(info);
  submap.MutableTsdf(kBlock).weight.fill(1);
  submap.MutableTsdf({0, 0, 0}).weight.fill(1);
  return submap;
}

TEST(GoneLayer, GoesWithSnapshotsForksAndClonesAndIsTheirOwn) {
  Map map{MapInfo()};
  const SubmapId id = AddSubmap(map).id();
  map.FindMutable(id)->MutableGone(kBlock).Set(5, 3);
  const auto first = map.Publish(1);
  Map fork = map.Fork();
  const SubmapId clone = map.Clone(id)->id();
  map.FindMutable(id)->MutableGone(kBlock).Set(6, 3);
  fork.FindMutable(id)->MutableGone(kBlock).Set(7, 3);
  const auto contradicted = [](const Submap* submap) {
    std::vector<int> voxels;
    const BlockEntry& entry = *submap->blocks().Find(kBlock);
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      if (entry.IsContradicted(linear)) voxels.push_back(linear);
      EXPECT_EQ(entry.Shows(linear), !entry.IsContradicted(linear));
    }
    return voxels;
  };
  EXPECT_EQ(contradicted(first->Find(id)), (std::vector{5}));
  EXPECT_EQ(contradicted(map.Find(id)), (std::vector{5, 6}));
  EXPECT_EQ(contradicted(map.Find(clone)), (std::vector{5}));
  EXPECT_EQ(contradicted(fork.Find(id)), (std::vector{5, 7}));

  const auto second = map.Publish(2);
  const auto changes = DiffSnapshots(first.get(), *second);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_TRUE(changes[0].written_tsdf.empty()) << "voxels stay as they were observed";
  ASSERT_EQ(changes[0].written_gone.size(), 1u);
  EXPECT_EQ(changes[0].written_gone[0]->index, kBlock);
  map.FindMutable(id)->DropGone();
  const auto third = map.Publish(3);
  EXPECT_EQ(DiffSnapshots(second.get(), *third)[0].erased_gone, (std::vector{kBlock}));
  EXPECT_TRUE(contradicted(third->Find(id)).empty());
  EXPECT_LT(third->Find(id)->MemoryBytes(), second->Find(id)->MemoryBytes());
}

}  // namespace
}  // namespace dhpmap

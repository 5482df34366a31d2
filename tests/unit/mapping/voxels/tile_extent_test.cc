// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/tile_extent.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "mapping/voxels/block_tile.h"

namespace dhpmap {
namespace {

constexpr TileIndex kMadeTile{-2, 0, 5};
constexpr int kSide = kTileSide * kBlockSide;

/// Where a voxel lies in its tile.
std::array<int, 3> PlaceOf(int cell, int linear) {
  const VoxelIndex voxel = VoxelIn(BlockIn(kMadeTile, cell), linear);
  return {voxel.x - kMadeTile.x * kSide, voxel.y - kMadeTile.y * kSide, voxel.z - kMadeTile.z * kSide};
}

TEST(TileExtent, IsAroundWhatAWalkOverAllVoxelsFinds) {
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    BlockTile tile;
    TileExtent expected;
    const int num_blocks = static_cast<int>(random() % 5);
    for (int n = 0; n < num_blocks; ++n) {
      const int cell = static_cast<int>(random() % kTileBlocks);
      auto tsdf = std::shared_ptr<TsdfBlock>(new TsdfBlock());
      const int num_voxels = static_cast<int>(random() % 4);
      for (int v = 0; v < num_voxels; ++v) {
        const auto linear = static_cast<std::size_t>(random() % kBlockVoxels);
        tsdf->weight[linear] = v == 0 ? kMinObservedWeight : v == 1 ? kMinObservedWeight / 2 : 1.0f;
      }
      tile.FindOrInsert(BlockIn(kMadeTile, cell)).tsdf = tsdf;
    }
    for (const BlockEntry& entry : tile.entries()) {
      for (int linear = 0; linear < kBlockVoxels; ++linear) {
        if (!entry.tsdf->IsObserved(linear)) continue;
        TileExtent voxel;
        const auto place = PlaceOf(CellOf(entry.index), linear);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          voxel.low[axis] = static_cast<std::uint8_t>(place[axis]);
          voxel.high[axis] = static_cast<std::uint8_t>(place[axis] + 1);
        }
        expected.Add(voxel);
      }
    }
    EXPECT_EQ(ExtentOf(tile.entries()), expected);
    EXPECT_EQ(tile.Extent(), expected);
    EXPECT_EQ(tile.KnownExtent(), expected);
    EXPECT_EQ(TileExtent::FromCode(expected.Code()), expected);
  }
}

TEST(TileExtent, OfATileThatIsWrittenToIsForgotten) {
  BlockTile tile;
  auto tsdf = std::shared_ptr<TsdfBlock>(new TsdfBlock());
  tsdf->weight[0] = 1;
  tile.FindOrInsert(BlockIn(kMadeTile, 0)).tsdf = tsdf;
  EXPECT_EQ(tile.Extent().high, (std::array<std::uint8_t, 3>{1, 1, 1}));
  tile.FindOrInsert(BlockIn(kMadeTile, 63)).tsdf = tsdf;
  EXPECT_EQ(tile.KnownExtent(), std::nullopt);
  EXPECT_EQ(tile.Extent().high, (std::array<std::uint8_t, 3>{25, 25, 25}));
  const BlockTile copy(tile);
  EXPECT_EQ(copy.KnownExtent(), std::nullopt) << "it is made to be written to";
  tile.Erase(63);
  EXPECT_EQ(tile.KnownExtent(), std::nullopt);
  (void)tile.Extent();
  (void)tile.mutable_entries();
  EXPECT_EQ(tile.KnownExtent(), std::nullopt);
}

TEST(TileExtent, WhatIsNoCodeSaysNothing) {
  const std::uint64_t known = TileExtent().Code();
  EXPECT_EQ(known, std::uint64_t{1} << 42);
  EXPECT_EQ(TileExtent::FromCode(known), TileExtent()) << "nothing is observed";
  const TileExtent all{.low = {0, 0, 0}, .high = {kSide, kSide, kSide}};
  EXPECT_EQ(TileExtent::FromCode(all.Code()), all);
  for (const std::uint64_t code : {std::uint64_t{0}, all.Code() ^ known, all.Code() + 2 * known, known | 5,
                                   all.Code() + (std::uint64_t{1} << 7)}) {
    EXPECT_EQ(TileExtent::FromCode(code), std::nullopt) << code;
  }
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/block_table.h"

#include <gtest/gtest.h>

#include <iterator>
#include <limits>
#include <map>
#include <random>

namespace dhpmap {
namespace {

constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();

/// A block that can be told from others: its first distance is `value`.
std::shared_ptr<const TsdfBlock> Marked(float value) {
  auto block = std::make_shared<TsdfBlock>();
  block->distance_m[0] = value;
  return block;
}

using NaiveTable = std::map<BlockIndex, float>;

NaiveTable ContentOf(const BlockTable& table) {
  NaiveTable content;
  for (const BlockEntry& entry : table.entries()) {
    EXPECT_TRUE(content.emplace(entry.index, entry.tsdf->distance_m[0]).second) << "visited twice";
  }
  return content;
}

void ExpectSameTable(const BlockTable& table, const NaiveTable& naive) {
  EXPECT_EQ(table.size(), naive.size());
  EXPECT_EQ(ContentOf(table), naive);
  for (const auto& [index, value] : naive) {
    const BlockEntry* entry = table.Find(index);
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->index, index);
    EXPECT_EQ(entry->tsdf->distance_m[0], value);
  }
}

TEST(BlockTable, AgreesWithAMapUnderRandomInsertionsAndErasuresAndSoDoItsCopies) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    const std::int32_t spread = seed % 2 == 0 ? 6 : 1000;  // crowded: many blocks a tile; wide: many tiles
    std::uniform_int_distribution<std::int32_t> coordinate(-spread, spread);
    BlockTable table;
    NaiveTable naive;
    std::uint64_t generation = 1;
    std::vector<std::pair<BlockTable, NaiveTable>> copies;
    for (int step = 0; step < 3000; ++step) {
      BlockIndex index{coordinate(random), coordinate(random), coordinate(random)};
      if (random() % 2 == 0 && !naive.empty()) {  // one that is there
        index = std::next(naive.begin(), static_cast<std::ptrdiff_t>(random() % naive.size()))->first;
      }
      const bool phase_of_growth = step / 500 % 2 == 0;
      if (random() % 10 < (phase_of_growth ? 7u : 3u)) {
        const auto value = static_cast<float>(step);
        table.FindOrInsert(index, generation).tsdf = Marked(value);
        naive[index] = value;
      } else {
        EXPECT_EQ(table.Erase(index, generation), naive.erase(index) == 1);
      }
      EXPECT_EQ(table.Find(index) != nullptr, naive.contains(index));
      if (step % 300 == 0) {
        copies.emplace_back(table, naive);
        ++generation;
      }
    }
    ExpectSameTable(table, naive);
    while (!table.empty()) EXPECT_TRUE(table.Erase(table.entries().front().index, generation));
    EXPECT_EQ(table.Find({0, 0, 0}), nullptr);
    EXPECT_TRUE(table.tiles().empty());
    for (const auto& [copy, content] : copies) ExpectSameTable(copy, content);
  }
}

TEST(BlockTable, HoldsExtremeIndices) {
  const BlockIndex indices[] = {{kLeast, kLeast, kLeast}, {kMost, kMost, kMost}, {0, 0, 0}, {-1, 0, kMost}};
  BlockTable table;
  for (const BlockIndex index : indices) table.FindOrInsert(index, 1);
  for (const BlockIndex index : indices) EXPECT_EQ(table.Find(index)->index, index);
  EXPECT_EQ(table.size(), 4u);
}

TEST(BlockTable, EmptyTableFindsAndErasesNothing) {
  BlockTable table;
  EXPECT_TRUE(table.empty());
  EXPECT_EQ(table.Find({1, 2, 3}), nullptr);
  EXPECT_EQ(table.FindTile({0, 0, 0}), nullptr);
  EXPECT_FALSE(table.Erase({1, 2, 3}, 1));
  EXPECT_EQ(table.entries().begin(), table.entries().end());
}

TEST(BlockTable, CopySharesTheTilesThatNobodyWritesTo) {
  BlockTable a;
  a.FindOrInsert({0, 0, 0}, 1).tsdf = Marked(5);
  a.FindOrInsert({100, 0, 0}, 1).tsdf = Marked(6);
  BlockTable b = a;
  b.FindOrInsert({1, 0, 0}, 2);
  EXPECT_EQ(a.size(), 2u);
  EXPECT_EQ(b.size(), 3u);
  EXPECT_EQ(a.FindTile({25, 0, 0})->tile, b.FindTile({25, 0, 0})->tile);
  EXPECT_NE(a.FindTile({0, 0, 0})->tile, b.FindTile({0, 0, 0})->tile);
  EXPECT_EQ(a.Find({0, 0, 0})->tsdf, b.Find({0, 0, 0})->tsdf) << "of a copied tile the blocks are still shared";
}

TEST(BlockTable, WhatAWriterOwnsItNoLongerOwnsAfterTheNextCopy) {
  BlockTable table;
  table.FindOrInsert({0, 0, 0}, 1).owns_tsdf = true;
  EXPECT_TRUE(table.FindOrInsert({0, 0, 0}, 1).owns_tsdf);
  const BlockTable copy = table;
  EXPECT_FALSE(table.FindOrInsert({0, 0, 0}, 2).owns_tsdf);

  table.FindOrInsert({0, 0, 0}, 2).owns_labels = true;
  BlockTable clone = table;
  table.ShareTiles();
  clone.ShareTiles();
  EXPECT_FALSE(table.FindOrInsert({0, 0, 0}, 2).owns_labels) << "of the same generation, and yet shared";
  EXPECT_FALSE(clone.FindOrInsert({0, 0, 0}, 2).owns_labels);
}

TEST(BlockTable, CountsItsMemory) {
  BlockTable table;
  EXPECT_LT(table.MemoryBytes(), 100u);
  table.FindOrInsert({0, 0, 0}, 1).tsdf = Marked(1);
  EXPECT_GE(table.MemoryBytes(), sizeof(TsdfBlock));
}

TEST(BlockTile, CellsAreInverseToBlocks) {
  for (const std::int32_t at : {kLeast, -5, -4, -1, 0, 1, 3, 4, kMost}) {
    const BlockIndex block{at, -at / 2, at / 3};
    EXPECT_EQ(BlockIn(TileOf(block), CellOf(block)), block);
  }
  EXPECT_EQ(TileOf({-1, -4, -5}), (TileIndex{-1, -1, -2}));
  EXPECT_EQ(CellOf({-1, 1, 6}), 3 + 4 * 1 + 16 * 2);
}

TEST(BlockTile, EntriesAreByAscendingCell) {
  std::mt19937 random(1);
  BlockTile tile;
  for (int i = 0; i < 40; ++i) tile.FindOrInsert(BlockIn({0, 0, 0}, static_cast<int>(random() % kTileBlocks)));
  for (std::size_t i = 1; i < tile.entries().size(); ++i) {
    EXPECT_LT(CellOf(tile.entries()[i - 1].index), CellOf(tile.entries()[i].index));
  }
}

}  // namespace
}  // namespace dhpmap

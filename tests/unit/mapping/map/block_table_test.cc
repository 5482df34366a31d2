// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/block_table.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace dhpmap {
namespace {

/// A block that can be told from others: its first distance is `value`.
std::shared_ptr<const TsdfBlock> Marked(float value) {
  auto block = std::make_shared<TsdfBlock>();
  block->distance_m[0] = value;
  return block;
}

void ExpectSame(const BlockTable& table, const std::map<BlockIndex, float>& naive) {
  ASSERT_EQ(table.size(), naive.size());
  ASSERT_EQ(table.entries().size(), naive.size());
  for (const auto& [index, value] : naive) {
    const BlockEntry* entry = table.Find(index);
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->index, index);
    EXPECT_EQ(entry->tsdf->distance_m[0], value);
  }
}

TEST(BlockTable, AgreesWithAMapUnderRandomInsertionsAndErasures) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    const std::int32_t spread = seed % 2 == 0 ? 3 : 1000;  // crowded: many erasures hit; wide: many collisions of slots
    std::uniform_int_distribution<std::int32_t> coordinate(-spread, spread);
    BlockTable table;
    std::map<BlockIndex, float> naive;
    for (int step = 0; step < 3000; ++step) {
      BlockIndex index{coordinate(random), coordinate(random), coordinate(random)};
      if (random() % 2 == 0 && !naive.empty()) {  // one that is there
        index = table.entries()[random() % table.size()].index;
      }
      const bool phase_of_growth = step / 500 % 2 == 0;
      if (random() % 10 < (phase_of_growth ? 7u : 3u)) {
        const auto value = static_cast<float>(step);
        table.FindOrInsert(index).tsdf = Marked(value);
        naive[index] = value;
      } else {
        EXPECT_EQ(table.Erase(index), naive.erase(index) == 1);
      }
      EXPECT_EQ(table.Find(index) != nullptr, naive.contains(index));
      if (step % 500 == 0) ExpectSame(table, naive);
    }
    ExpectSame(table, naive);
    while (!table.empty()) EXPECT_TRUE(table.Erase(table.entries().front().index));
    EXPECT_EQ(table.Find({0, 0, 0}), nullptr);
  }
}

TEST(BlockTable, HoldsExtremeIndices) {
  constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  const BlockIndex indices[] = {{kLeast, kLeast, kLeast}, {kMost, kMost, kMost}, {0, 0, 0}, {-1, 0, kMost}};
  BlockTable table;
  for (const BlockIndex index : indices) table.FindOrInsert(index);
  for (const BlockIndex index : indices) EXPECT_EQ(table.Find(index)->index, index);
  EXPECT_EQ(table.size(), 4u);
}

TEST(BlockTable, EmptyTableFindsAndErasesNothing) {
  BlockTable table;
  EXPECT_TRUE(table.empty());
  EXPECT_EQ(table.Find({1, 2, 3}), nullptr);
  EXPECT_FALSE(table.Erase({1, 2, 3}));
}

TEST(BlockTable, EntriesKeepTheOrderOfAllocation) {
  BlockTable table;
  for (int i = 0; i < 100; ++i) table.FindOrInsert({-i, i, 7});
  table.FindOrInsert({-3, 3, 7});
  ASSERT_EQ(table.size(), 100u);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(table.entries()[i].index, (BlockIndex{-i, i, 7}));
}

TEST(BlockTable, CopySharesBlocksButNotTheTable) {
  BlockTable a;
  a.FindOrInsert({1, 1, 1}).tsdf = Marked(5);
  BlockTable b = a;
  EXPECT_EQ(a.Find({1, 1, 1})->tsdf, b.Find({1, 1, 1})->tsdf);
  b.FindOrInsert({2, 2, 2});
  b.Erase({1, 1, 1});
  EXPECT_EQ(a.size(), 1u);
  EXPECT_NE(a.Find({1, 1, 1}), nullptr);
  EXPECT_EQ(a.Find({2, 2, 2}), nullptr);
}

TEST(BlockTable, CountsItsMemory) {
  BlockTable table;
  EXPECT_LT(table.MemoryBytes(), 100u);
  table.FindOrInsert({0, 0, 0}).tsdf = Marked(1);
  EXPECT_GE(table.MemoryBytes(), sizeof(TsdfBlock));
}

}  // namespace
}  // namespace dhpmap

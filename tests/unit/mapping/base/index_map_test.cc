// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/index_map.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace dhpmap {
namespace {

using Map = IndexMap<BlockIndex>;

TEST(IndexMap, AgreesWithAMapUnderRandomSetsAndErasures) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    const std::int32_t spread = seed % 2 == 0 ? 3 : 1000;  // crowded: many erasures hit; wide: many collisions of slots
    std::uniform_int_distribution<std::int32_t> coordinate(-spread, spread);
    Map table;
    std::map<BlockIndex, std::uint32_t> naive;
    for (std::uint32_t step = 0; step < 3000; ++step) {
      const BlockIndex index{coordinate(random), coordinate(random), coordinate(random)};
      if (random() % 10 < (step / 500 % 2 == 0 ? 7u : 3u)) {
        table.Set(index, step);
        naive[index] = step;
      } else {
        EXPECT_EQ(table.Erase(index), naive.erase(index) == 1);
      }
      ASSERT_EQ(table.size(), naive.size());
      if (step % 100 != 0) continue;
      for (const auto& [key, number] : naive) ASSERT_EQ(table.Find(key), number);
    }
    for (const auto& [key, number] : naive) EXPECT_TRUE(table.Erase(key));
    EXPECT_EQ(table.size(), 0u);
    for (const auto& [key, number] : naive) EXPECT_EQ(table.Find(key), Map::kNone);
  }
}

TEST(IndexMap, EmptyFindsAndErasesNothing) {
  Map table;
  EXPECT_EQ(table.Find({1, 2, 3}), Map::kNone);
  EXPECT_FALSE(table.Erase({1, 2, 3}));
}

TEST(IndexMap, ReservingKeepsWhatIsThere) {
  Map table;
  table.Set({1, 2, 3}, 7);
  table.Reserve(1000);
  const std::size_t bytes = table.MemoryBytes();
  for (std::int32_t i = 0; i < 999; ++i) table.Set({i, 0, 0}, static_cast<std::uint32_t>(i));
  EXPECT_EQ(table.MemoryBytes(), bytes);
  EXPECT_EQ(table.Find({1, 2, 3}), 7u);
}

}  // namespace
}  // namespace dhpmap

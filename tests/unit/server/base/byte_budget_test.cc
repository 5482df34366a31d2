// SPDX-License-Identifier: BSD-3-Clause
#include "server/base/byte_budget.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

TEST(ByteBudget, GrantsNoMoreThanItsLimit) {
  ByteBudget budget(100);
  ByteShare first(&budget), second(&budget);
  EXPECT_TRUE(first.Resize(60));
  EXPECT_FALSE(second.Resize(41));
  EXPECT_EQ(second.bytes(), 0u) << "all or nothing";
  EXPECT_TRUE(second.Resize(40));
  EXPECT_FALSE(first.Resize(61));
  EXPECT_TRUE(first.Resize(10)) << "giving back always works";
  EXPECT_TRUE(second.Resize(90));
  EXPECT_FALSE(second.Resize(~std::size_t{0})) << "no overflow";
}

TEST(ByteBudget, ANestedBudgetTakesFromBothOrNeither) {
  const auto all = std::make_shared<ByteBudget>(100);
  ByteBudget first(60, 0, all), second(60, 0, all);
  EXPECT_FALSE(first.TryTake(61));
  EXPECT_EQ(all->used_bytes(), 0u);
  EXPECT_TRUE(first.TryTake(60));
  EXPECT_EQ(all->used_bytes(), 60u);
  EXPECT_FALSE(second.TryTake(41)) << "there is not so much left for all";
  EXPECT_EQ(second.used_bytes(), 0u);
  EXPECT_TRUE(second.TryTake(40));
  first.GiveBack(60);
  EXPECT_EQ(all->used_bytes(), 40u);
}

TEST(ByteBudget, TheEndOfAShareReturnsItsBytes) {
  ByteBudget budget(100);
  {
    ByteShare share(&budget);
    ASSERT_TRUE(share.Resize(100));
    const ByteShare moved(std::move(share));
    EXPECT_EQ(budget.used_bytes(), 100u);
  }
  EXPECT_EQ(budget.used_bytes(), 0u);
}

/// A callback may be freed shortly after it has released its share, when its server no longer exists.
TEST(ByteBudget, AnEmptyShareMayOutliveIt) {
  auto budget = std::make_unique<ByteBudget>(100);
  ByteShare released(budget.get()), moved_from(budget.get()), unused(budget.get());
  ASSERT_TRUE(released.Resize(40) && moved_from.Resize(50));
  {
    const ByteShare moved(std::move(moved_from));
    released.Release();
    EXPECT_EQ(budget->used_bytes(), 50u);
  }
  EXPECT_EQ(budget->used_bytes(), 0u);
  budget.reset();  // a sanitizer's build sees who comes back
}

TEST(ByteBudget, SmallSharesCostNothing) {
  ByteBudget budget(100, /*free_bytes=*/10);
  ByteShare large(&budget), small(&budget);
  EXPECT_TRUE(large.Resize(100));
  EXPECT_TRUE(small.Resize(10)) << "although the budget is spent";
  EXPECT_FALSE(small.Resize(11)) << "then all of it counts";
  EXPECT_EQ(small.bytes(), 10u);
  large.Release();
  EXPECT_EQ(budget.used_bytes(), 0u);
  EXPECT_TRUE(small.Resize(11));
  EXPECT_EQ(budget.used_bytes(), 11u);
  EXPECT_TRUE(small.Resize(10));
  EXPECT_EQ(budget.used_bytes(), 0u);
}

TEST(ByteBudget, AHugeShareTakesTheWholeBudget) {
  ByteBudget budget(100);
  ByteShare huge(&budget), other(&budget);
  ASSERT_TRUE(huge.Resize(1));
  EXPECT_TRUE(huge.Grow(1000));
  EXPECT_EQ(budget.used_bytes(), 100u);
  EXPECT_FALSE(other.Grow(1));
  huge.Release();
  ASSERT_TRUE(other.Grow(1));
  EXPECT_FALSE(huge.Grow(1000)) << "not beside others";
  EXPECT_TRUE(huge.Grow(99));
}

TEST(ByteBudget, IsExactWithManyThreads) {
  ByteBudget budget(1000);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&budget] {
      for (int i = 0; i < 5000; ++i) {
        ByteShare share(&budget);
        if (share.Resize(static_cast<std::size_t>(i % 700))) {
          EXPECT_LE(budget.used_bytes(), 1000u);
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(budget.used_bytes(), 0u);
}

}  // namespace
}  // namespace dhpmap

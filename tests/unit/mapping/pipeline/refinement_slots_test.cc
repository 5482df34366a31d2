// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/refinement_slots.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace dhpmap {
namespace {

TEST(RefinementSlots, GivesOutNoMoreThanThereAre) {
  const auto slots = std::make_shared<RefinementSlots>(2);
  auto first = RefinementSlots::TryTake(slots);
  {
    const auto second = RefinementSlots::TryTake(slots);
    EXPECT_TRUE(first && second);
    EXPECT_FALSE(RefinementSlots::TryTake(slots));
  }
  const auto third = RefinementSlots::TryTake(slots);
  EXPECT_TRUE(third) << "the second is free again";
  const auto moved = std::move(first);
  EXPECT_FALSE(RefinementSlots::TryTake(slots)) << "the first has only moved";
}

TEST(RefinementSlots, WaitsUntilOneIsFreeOrNobodyWantsIt) {
  const auto slots = std::make_shared<RefinementSlots>(1);
  auto held = RefinementSlots::TryTake(slots);
  EXPECT_FALSE(RefinementSlots::Take(slots, [] { return true; }));
  std::atomic<bool> has_it = false;
  std::thread waiter([&] { has_it = RefinementSlots::Take(slots, {}).has_value(); });
  EXPECT_FALSE(has_it);
  held.reset();
  waiter.join();
  EXPECT_TRUE(has_it);
}

TEST(RefinementSlots, AreNeverMoreInUseWithManyThreads) {
  constexpr int kSlots = 3;
  const auto slots = std::make_shared<RefinementSlots>(kSlots);
  std::atomic<int> num_in_use = 0, most = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 200; ++i) {
        const auto slot = RefinementSlots::Take(slots, {});
        const int now = ++num_in_use;
        int seen = most;
        while (seen < now && !most.compare_exchange_weak(seen, now)) {
        }
        --num_in_use;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(most, kSlots);
  EXPECT_GE(most, 1);
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "storage/fair_mutex.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "tests/support/eventually.h"

namespace dhpmap {
namespace {

TEST(FairMutex, IsHadInTheOrderInWhichItWasAskedFor) {
  constexpr int kThreads = 4;
  FairMutex mutex;
  std::vector<int> order;
  std::vector<std::thread> threads;
  mutex.Lock();
  for (int n = 0; n < kThreads; ++n) {
    threads.emplace_back([&, n] {
      const FairMutexLock lock(mutex);
      order.push_back(n);
    });
    EXPECT_TRUE(testing::Eventually([&] { return mutex.num_in_line() == static_cast<std::uint64_t>(n) + 2; }));
  }
  mutex.Unlock();
  mutex.Lock();  // at once, before any of them is awake
  order.push_back(kThreads);
  mutex.Unlock();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, kThreads}));
  EXPECT_EQ(mutex.num_in_line(), 0u);
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>

namespace dhpmap {
namespace {

class ThreadPools : public ::testing::TestWithParam<int> {};

TEST_P(ThreadPools, RunEveryItemOnceInManyLoopsInARow) {
  ThreadPool pool(GetParam());
  EXPECT_EQ(pool.num_threads(), GetParam());
  for (std::size_t count = 0; count < 200; ++count) {
    std::vector<std::atomic<int>> times(count);
    pool.ParallelFor(count, [&times](std::size_t i) { ++times[i]; });
    for (const auto& t : times) ASSERT_EQ(t, 1);
  }
}

TEST_P(ThreadPools, ReturnOnlyWhenAllItemsAreDone) {
  ThreadPool pool(GetParam());
  for (int round = 0; round < 50; ++round) {
    std::vector<int> results(64, 0);  // not atomic: the end of the loop must make the writes visible
    pool.ParallelFor(results.size(), [&results](std::size_t i) {
      for (std::size_t k = 0; k < i * 50; ++k) results[i] += static_cast<int>(k % 3);
      results[i] = static_cast<int>(i);
    });
    for (std::size_t i = 0; i < results.size(); ++i) ASSERT_EQ(results[i], static_cast<int>(i));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, ThreadPools, ::testing::Values(1, 2, 5));

TEST(ThreadPool, OfOneRunsInPlaceAndInOrder) {
  ThreadPool pool(1);
  std::vector<std::size_t> order;
  pool.ParallelFor(5, [&order](std::size_t i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

TEST(ThreadPool, OfTwoUsesBothThreads) {
  ThreadPool pool(2);
  std::mutex mutex;
  std::set<std::thread::id> threads;
  std::atomic<int> arrived = 0;
  // Two items that wait for each other can only end on two threads.
  pool.ParallelFor(2, [&](std::size_t) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(threads.size(), 2u);
}

TEST(ThreadPool, ZeroMeansOneThreadACore) { EXPECT_GE(ThreadPool(0).num_threads(), 1); }

TEST(ThreadPool, EndsWithoutEverHavingRun) {
  for (int i = 0; i < 20; ++i) const ThreadPool pool(3);
}

}  // namespace
}  // namespace dhpmap

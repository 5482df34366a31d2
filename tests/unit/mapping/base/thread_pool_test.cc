// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/thread_pool.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <thread>

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

TEST_P(ThreadPools, HandTheFirstExceptionToTheCallerAndGoOn) {
  ThreadPool pool(GetParam());
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> begun = 0, ended = 0;
    const auto body = [&](std::size_t i) {
      ++begun;
      if (i == 7) throw std::runtime_error("item 7");
      std::this_thread::yield();
      ++ended;
    };
    try {
      pool.ParallelFor(100'000, body);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "item 7");
    }
    const int begun_then = begun;
    EXPECT_EQ(ended + 1, begun_then) << "an item was still running";
    EXPECT_LT(begun_then, 100'000) << "items that had not begun were run";
    std::atomic<int> sum = 0;
    pool.ParallelFor(10, [&sum](std::size_t i) { sum += static_cast<int>(i); });
    EXPECT_EQ(sum, 45) << "the pool works on";
  }
}

TEST_P(ThreadPools, RunLoopsOfSeveralCallersAtOnce) {
  ThreadPool pool(GetParam());
  constexpr std::size_t kCallers = 6;
  std::vector<std::int64_t> sums(kCallers, 0);
  std::vector<std::thread> callers;
  for (std::size_t c = 0; c < kCallers; ++c) {
    callers.emplace_back([&pool, &sums, c] {
      for (int round = 0; round < 100; ++round) {
        std::vector<std::int64_t> values(c * 30 + 1, 0);
        pool.ParallelFor(values.size(), [&values, c](std::size_t i) { values[i] = static_cast<std::int64_t>(c * i); });
        for (const std::int64_t value : values) sums[c] += value;
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  for (std::size_t c = 0; c < kCallers; ++c) {
    const auto n = static_cast<std::int64_t>(c * 30);
    EXPECT_EQ(sums[c], 100 * static_cast<std::int64_t>(c) * n * (n + 1) / 2);
  }
}

TEST_P(ThreadPools, RunALoopWithinALoop) {
  ThreadPool pool(GetParam());
  std::atomic<int> sum = 0;
  pool.ParallelFor(20, [&](std::size_t) { pool.ParallelFor(30, [&](std::size_t) { ++sum; }); });
  EXPECT_EQ(sum, 600);
}

TEST(ThreadPool, AThrowingCallerDoesNotDisturbAnother) {
  ThreadPool pool(3);
  std::atomic<bool> ends = false;
  std::thread other([&] {
    while (!ends) EXPECT_THROW(pool.ParallelFor(50, [](std::size_t) { throw std::bad_alloc(); }), std::bad_alloc);
  });
  for (int round = 0; round < 300; ++round) {
    std::vector<std::atomic<int>> times(40);
    pool.ParallelFor(times.size(), [&times](std::size_t i) { ++times[i]; });
    for (const auto& t : times) ASSERT_EQ(t, 1);
  }
  ends = true;
  other.join();
}

TEST(ThreadPool, ZeroMeansOneThreadACore) { EXPECT_GE(ThreadPool(0).num_threads(), 1); }

TEST(ThreadPool, EndsWithoutEverHavingRun) {
  for (int i = 0; i < 20; ++i) const ThreadPool pool(3);
}

TEST(ThreadPool, ItsThreadsAreAsNiceAsAskedAndItsCallersAsTheyWere) {
  const int here = getpriority(PRIO_PROCESS, 0);
  const std::thread::id caller = std::this_thread::get_id();
  ThreadPool pool(3, 4);
  std::atomic<int> num_others = 0;
  // Until one of the others has had an item: they come when they come.
  while (num_others == 0) {
    pool.ParallelFor(64, [&](std::size_t) {
      const bool is_caller = std::this_thread::get_id() == caller;
      EXPECT_EQ(getpriority(PRIO_PROCESS, 0), is_caller ? here : std::min(here + 4, 19));
      if (!is_caller) ++num_others;
      std::this_thread::yield();
    });
  }
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), here);
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/bounded_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <random>
#include <stdexcept>
#include <vector>

namespace dhpmap {
namespace {

std::vector<std::size_t> RandomSizes(std::size_t count, std::size_t largest) {
  std::mt19937 random(3);
  std::vector<std::size_t> sizes(count);
  for (std::size_t& size : sizes) size = 1 + random() % largest;
  std::sort(sizes.rbegin(), sizes.rend());
  return sizes;
}

/// Adds up what is under way.
class Scale {
 public:
  void Put(std::size_t size) {
    const std::lock_guard lock(mutex_);
    now_ += size;
    ++count_;
    if (count_ > 1) most_together_ = std::max(most_together_, now_);
  }
  void Take(std::size_t size) {
    const std::lock_guard lock(mutex_);
    now_ -= size;
    --count_;
  }
  [[nodiscard]] std::size_t most_together() const { return most_together_; }

 private:
  std::mutex mutex_;
  std::size_t now_ = 0, count_ = 0, most_together_ = 0;
};

TEST(BoundedParallelForTest, RunsEveryItemOnceWithinTheBound) {
  const std::vector<std::size_t> sizes = RandomSizes(2000, 130);
  for (const int num_threads : {1, 2, 4}) {
    ThreadPool pool(num_threads);
    std::vector<std::atomic<int>> runs(sizes.size());
    Scale scale;
    BoundedParallelFor(pool, sizes, 100, [&](std::size_t i) {
      scale.Put(sizes[i]);
      ++runs[i];
      scale.Take(sizes[i]);
    });
    EXPECT_LE(scale.most_together(), 100u) << num_threads;
    for (const auto& count : runs) ASSERT_EQ(count, 1) << num_threads;
  }
}

TEST(BoundedParallelForTest, OneThreadTakesTheLargestFirst) {
  ThreadPool pool(1);
  const std::vector<std::size_t> sizes = {9, 5, 5, 1};
  std::vector<std::size_t> order;
  BoundedParallelFor(pool, sizes, 3, [&](std::size_t i) { order.push_back(i); });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(BoundedParallelForTest, SmallItemsRunBesideALargeOne) {
  ThreadPool pool(2);
  const std::vector<std::size_t> sizes = {9, 8, 1};
  std::atomic<bool> small_has_run = false;
  // The large one ends only after the small one, which so must have been let pass what does not fit beside it.
  BoundedParallelFor(pool, sizes, 10, [&](std::size_t i) {
    if (i == 2) {
      small_has_run = true;
      small_has_run.notify_all();
    } else if (i == 0) {
      small_has_run.wait(false);
    }
  });
  EXPECT_TRUE(small_has_run);
}

TEST(BoundedParallelForTest, AnExceptionIsTheCallersAndNobodyWaitsForEver) {
  const std::vector<std::size_t> sizes = RandomSizes(200, 100);
  for (const int num_threads : {1, 2, 4}) {
    ThreadPool pool(num_threads);
    std::atomic<int> runs = 0;
    EXPECT_THROW(BoundedParallelFor(pool, sizes, 100,
                                    [&](std::size_t i) {
                                      ++runs;
                                      if (i == 5) throw std::runtime_error("5");
                                    }),
                 std::runtime_error);
    EXPECT_LT(runs, 200);
  }
}

TEST(BoundedParallelForTest, NothingIsDoneForNoItems) {
  ThreadPool pool(2);
  BoundedParallelFor(pool, {}, 1, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/lazy_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "mapping/base/mutex.h"
#include "tests/support/eventually.h"

namespace dhpmap {
namespace {

TEST(LazyThread, RunsOnceAfterItsStart) {
  std::atomic<int> num_runs = 0;
  LazyThread thread;
  thread.Join();
  EXPECT_EQ(num_runs, 0);
  EXPECT_TRUE(thread.Start([&] { ++num_runs; }).ok());
  EXPECT_TRUE(thread.Start([&] { ++num_runs; }).ok());
  thread.Join();
  EXPECT_EQ(num_runs, 1);
}

TEST(LazyThread, RunsAgainAfterItHasRetired) {
  Mutex mutex;
  int num_runs = 0;
  LazyThread thread;
  EXPECT_FALSE(thread.has_run());
  const auto start = [&] {
    const MutexLock lock(mutex);
    return thread.Start([&] {
      const MutexLock inner(mutex);
      ++num_runs;
      thread.Retire();
    });
  };
  for (int run = 1; run <= 100; ++run) {
    EXPECT_TRUE(start().ok());
    const auto has_run = [&] {
      const MutexLock lock(mutex);
      return num_runs == run;
    };
    EXPECT_TRUE(testing::Eventually(has_run));
  }
  thread.Join();
  EXPECT_TRUE(thread.has_run());
  EXPECT_EQ(num_runs, 100);
}

}  // namespace
}  // namespace dhpmap

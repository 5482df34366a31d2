// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/lazy_thread.h"

#include <gtest/gtest.h>

#include <atomic>

namespace dhpmap {
namespace {

TEST(LazyThread, BeginsOnceAndNotBeforeItIsStarted) {
  std::atomic<int> num_runs = 0;
  LazyThread thread;
  thread.Join();
  EXPECT_EQ(num_runs, 0);
  EXPECT_TRUE(thread.Start([&] { ++num_runs; }).ok());
  EXPECT_TRUE(thread.Start([&] { ++num_runs; }).ok());
  thread.Join();
  EXPECT_EQ(num_runs, 1);
}

}  // namespace
}  // namespace dhpmap

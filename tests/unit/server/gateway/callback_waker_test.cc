// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/callback_waker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "tests/support/eventually.h"

namespace dhpmap::gateway {
namespace {

using std::chrono::milliseconds;

TEST(CallbackWaker, EventsKeepComingWhileItLives) {
  CallbackWaker waker(milliseconds(1));
  EXPECT_TRUE(testing::Eventually([&] { return waker.num_events() >= 5; }));
}

TEST(CallbackWaker, EndsBetweenAndDuringEvents) {
  for (int round = 0; round < 50; ++round) {
    CallbackWaker waker(milliseconds(round % 3));  // 0: an event is nearly always under way
    const int wanted = round % 4;
    while (round % 3 == 0 && waker.num_events() < wanted) std::this_thread::yield();
  }
}

TEST(CallbackWaker, DoesNotWaitForItsPeriodToEnd) { const CallbackWaker waker(std::chrono::hours(1000)); }

TEST(CallbackWaker, SeveralDoNotDisturbEachOther) {
  std::vector<std::unique_ptr<CallbackWaker>> wakers;
  for (int i = 0; i < 4; ++i) wakers.push_back(std::make_unique<CallbackWaker>(milliseconds(1)));
  wakers.erase(wakers.begin(), wakers.begin() + 2);
  const std::int64_t before = wakers.front()->num_events();
  EXPECT_TRUE(testing::Eventually([&] { return wakers.front()->num_events() > before; }));
}

}  // namespace
}  // namespace dhpmap::gateway

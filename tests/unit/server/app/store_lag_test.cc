// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/store_lag.h"

#include <gtest/gtest.h>

namespace dhpmap {
namespace {

StoreLag::Clock::time_point At(int seconds) { return StoreLag::Clock::time_point(std::chrono::seconds(seconds)); }

TEST(StoreLag, IsTheAgeOfTheOldestUnstoredFrame) {
  StoreLag lag;
  EXPECT_EQ(lag.Seconds(At(100)), 0);
  lag.OnFused(1, At(100));
  lag.OnFused(2, At(104));
  EXPECT_EQ(lag.Seconds(At(110)), 10);
  lag.OnStored(0);
  EXPECT_EQ(lag.Seconds(At(110)), 10);
  lag.OnStored(2);
  EXPECT_EQ(lag.Seconds(At(1000)), 0);
}

TEST(StoreLag, OfAStoreThatKeepsUpStaysSmall) {
  StoreLag lag;
  double worst_s = 0;
  for (int second = 1; second < 1000; ++second) {
    lag.OnFused(second, At(second));
    if (second % 2 == 0) lag.OnStored(second - 1);  // never all of them
    worst_s = std::max(worst_s, lag.Seconds(At(second)));
  }
  EXPECT_LE(worst_s, 4);
}

TEST(StoreLag, GrowsWhileNothingIsStored) {
  StoreLag lag;
  for (int second = 0; second < 50; ++second) lag.OnFused(second + 1, At(second));
  EXPECT_EQ(lag.Seconds(At(50)), 50);
}

}  // namespace
}  // namespace dhpmap

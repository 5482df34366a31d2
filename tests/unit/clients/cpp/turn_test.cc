// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/turn.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>

#include "tests/support/eventually.h"

namespace dhpmap::client {
namespace {

using Clock = OneAtATime::Clock;

TEST(OneAtATime, WhoComesSecondGivesUpAtItsDeadlineAndNotLater) {
  OneAtATime turns;
  const Turn first(turns, Clock::now());
  ASSERT_TRUE(first.is_ours()) << "it is free, however late it is";
  {
    const Turn second(turns, Clock::now());
    EXPECT_FALSE(second.is_ours());
  }
  EXPECT_FALSE(turns.Take(Clock::now())) << "whoever gave up has given nothing back";
}

TEST(OneAtATime, WhoWaitsIsNext) {
  OneAtATime turns;
  auto first = std::make_unique<Turn>(turns, Clock::now());
  std::thread waiting([&] {
    const Turn second(turns, Clock::now() + testing::kPatience);
    EXPECT_TRUE(second.is_ours());
  });
  first.reset();
  waiting.join();
}

}  // namespace
}  // namespace dhpmap::client

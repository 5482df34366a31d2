// SPDX-License-Identifier: BSD-3-Clause
#include "server/service/watchdog.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <latch>
#include <string>
#include <utility>
#include <vector>

#include "server/base/lane.h"
#include "tests/support/lane_plug.h"

namespace dhpmap::service {
namespace {

using std::chrono::microseconds;
using testing::LanePlug;

TEST(WatchdogTime, IsTheManagersSettingForThisProcess) {
  constexpr int kOwnPid = 42;
  EXPECT_EQ(WatchdogTime({"WATCHDOG_USEC=30000000"}, kOwnPid), microseconds(30'000'000));
  EXPECT_EQ(WatchdogTime({"WATCHDOG_PID=42", "WATCHDOG_USEC=5"}, kOwnPid), microseconds(5));
  EXPECT_EQ(WatchdogTime({"WATCHDOG_PID=41", "WATCHDOG_USEC=5"}, kOwnPid), std::nullopt) << "a child of the service's";
  for (const char* time : {"", "0", "-1", "5s", "99999999999999999999", "1000000000001"}) {
    EXPECT_EQ(WatchdogTime({std::string("WATCHDOG_USEC=") + time}, kOwnPid), std::nullopt) << time;
  }
  EXPECT_EQ(WatchdogTime({}, kOwnPid), std::nullopt);
}

LanePulse::Post To(Lane& lane) {
  return [&lane](std::function<void()> work) { return lane.TryPost(std::make_shared<LaneTask>(std::move(work))); };
}

TEST(LanePulse, ChangesOnlyOnceTheLaneHasRunTheBeat) {
  std::atomic<int> num_felt = 0;
  {
    Lane lane({.num_threads = 1});
    LanePulse pulse(To(lane), [&] { ++num_felt; });
    LanePlug plug(lane);
    pulse.Beat();
    EXPECT_EQ(num_felt, 0) << "the only thread of the lane is busy";
    plug.Release();
  }
  EXPECT_EQ(num_felt, 1);
}

TEST(LanePulse, SendsNoBeatWhileOneIsQueued) {
  std::vector<std::function<void()>> posted;
  int num_felt = 0;
  LanePulse pulse(
      [&](std::function<void()> work) {
        posted.push_back(std::move(work));
        return true;
      },
      [&] { ++num_felt; });
  for (int i = 0; i < 3; ++i) pulse.Beat();
  ASSERT_EQ(posted.size(), 1u);
  posted[0]();
  EXPECT_EQ(num_felt, 1);
  pulse.Beat();
  EXPECT_EQ(posted.size(), 2u);
}

TEST(LanePulse, TriesAgainAfterAFullLane) {
  int num_tries = 0;
  LanePulse pulse(
      [&](const std::function<void()>&) {
        ++num_tries;
        return false;
      },
      [] { FAIL() << "nothing ran"; });
  pulse.Beat();
  pulse.Beat();
  EXPECT_EQ(num_tries, 2);
}

TEST(Watchdog, BeatsPeriodicallyUntilItsDestruction) {
  constexpr int kBeats = 5;
  std::latch felt(kBeats);
  std::atomic<int> num_felt = 0;
  Lane lane({.num_threads = 1});
  {
    const Watchdog watchdog(microseconds(3), LanePulse(To(lane), [&] {
                              if (++num_felt <= kBeats) felt.count_down();
                            }));
    felt.wait();
  }
  EXPECT_GE(num_felt, kBeats);
}

}  // namespace
}  // namespace dhpmap::service

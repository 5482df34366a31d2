// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/this_thread.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <thread>

namespace dhpmap {
namespace {

int Niceness() { return getpriority(PRIO_PROCESS, 0); }

/// As the kernel has it: the seventh field of what sched_getattr(2) fills in is at byte 24.
std::uint64_t Turn_ns() {
  std::array<std::uint64_t, 6> attributes{};
  EXPECT_EQ(syscall(SYS_sched_getattr, 0, attributes.data(), sizeof attributes, 0), 0);
  return attributes[3];
}

TEST(ThisThread, IsNicerAloneAndSoIsWhatItStarts) {
  const int before = Niceness();
  if (before > 15) GTEST_SKIP() << "this process cannot be much nicer";
  int itself = 0, child = 0;
  std::thread([&] {
    MakeThisThreadNicer(3);
    itself = Niceness();
    std::thread([&] { child = Niceness(); }).join();
  }).join();
  EXPECT_EQ(itself, before + 3);
  EXPECT_EQ(child, before + 3);
  EXPECT_EQ(Niceness(), before);
}

TEST(ThisThread, IsNeverLessNice) {
  const int before = Niceness();
  std::thread([&] {
    MakeThisThreadNicer(-5);
    EXPECT_EQ(Niceness(), before);
    MakeThisThreadNicer(0);
    EXPECT_EQ(Niceness(), before);
    EXPECT_FALSE(IsThisThreadNicer());
  }).join();
}

TEST(ThisThread, KnowsThatItWasMadeNicer) {
  std::thread([] {
    MakeThisThreadNicer(1);
    EXPECT_TRUE(IsThisThreadNicer());
    std::thread([] { EXPECT_FALSE(IsThisThreadNicer()) << "what it starts was not made so itself"; }).join();
  }).join();
  EXPECT_FALSE(IsThisThreadNicer());
}

TEST(ThisThread, TakesShortTurnsAndSoDoesWhatItStartsUntilItSaysOtherwise) {
  std::thread([] {
    MakeThisThreadNicer(1);
    const int before = Niceness();
    if (!TakeTurns(Turns::kShort)) GTEST_SKIP() << "this kernel has ordinary turns only";
    EXPECT_EQ(Niceness(), before);
    std::thread([before] {
      EXPECT_EQ(Turn_ns(), 100'000u);
      EXPECT_EQ(Niceness(), before);
      EXPECT_TRUE(TakeTurns(Turns::kOrdinary));
      EXPECT_GT(Turn_ns(), 100'000u);
    }).join();
    EXPECT_EQ(Turn_ns(), 100'000u);
  }).join();
}

TEST(ThisThread, HasTheNameItWasGiven) {
  std::thread([] {
    NameThisThread("planner-7");
    char name[16] = {};
    ASSERT_EQ(pthread_getname_np(pthread_self(), name, sizeof name), 0);
    EXPECT_STREQ(name, "planner-7");
  }).join();
}

}  // namespace
}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/this_thread.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/resource.h>

#include <thread>

namespace dhpmap {
namespace {

int Niceness() { return getpriority(PRIO_PROCESS, 0); }

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

// SPDX-License-Identifier: BSD-3-Clause
#include "server/base/lane.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <atomic>
#include <future>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/eventually.h"
#include "tests/support/lane_plug.h"

namespace dhpmap {
namespace {

using Plug = testing::LanePlug;

std::shared_ptr<LaneTask> Task(std::function<void()> work) { return std::make_shared<LaneTask>(std::move(work)); }

TEST(Lane, RunsTasksInOrder) {
  std::vector<int> order;
  {
    Lane lane({.num_threads = 1});
    Plug plug(lane);
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(lane.TryPost(Task([&order, i] { order.push_back(i); })));
    plug.Release();
  }
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Lane, TasksPostedLastRunWhenNoOthersWait) {
  std::vector<int> order;
  {
    Lane lane({.num_threads = 1});
    Plug plug(lane);
    ASSERT_TRUE(lane.TryPostLast(Task([&order] { order.push_back(3); })));
    ASSERT_TRUE(lane.TryPostLast(Task([&order] { order.push_back(4); })));
    ASSERT_TRUE(lane.TryPost(Task([&order, &lane] {
      order.push_back(0);
      lane.Post([&order] { order.push_back(2); });  // continues with it
    })));
    ASSERT_TRUE(lane.TryPost(Task([&order] { order.push_back(1); })));
    plug.Release();
  }
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(Lane, CountsTasksPostedLastAsWaiting) {
  Lane lane({.num_threads = 1, .max_waiting = 2});
  Plug plug(lane);
  const auto dead = Task([] {});
  EXPECT_TRUE(lane.TryPostLast(dead));
  EXPECT_TRUE(lane.TryPost(Task([] {})));
  EXPECT_FALSE(lane.TryPostLast(Task([] {})));
  EXPECT_TRUE(dead->GiveUp());
  EXPECT_TRUE(lane.TryPostLast(Task([] {}))) << "the place of what was given up is free";
  plug.Release();
}

TEST(Lane, AcceptsALimitedNumberOfWaitingTasks) {
  Lane lane({.num_threads = 1, .max_waiting = 2});
  Plug plug(lane);
  EXPECT_TRUE(lane.TryPost(Task([] {})));
  EXPECT_TRUE(lane.TryPost(Task([] {})));
  EXPECT_FALSE(lane.TryPost(Task([] {})));
  plug.Release();
}

TEST(Lane, CancelledWorkNeverRunsAndFreesItsPlace) {
  std::atomic<int> runs = 0;
  {
    Lane lane({.num_threads = 1, .max_waiting = 2});
    Plug plug(lane);
    const auto dead = Task([&runs] { runs += 100; });
    ASSERT_TRUE(lane.TryPost(dead));
    ASSERT_TRUE(lane.TryPost(Task([&runs] { ++runs; })));
    EXPECT_TRUE(dead->GiveUp());
    EXPECT_FALSE(dead->GiveUp()) << "only once";
    EXPECT_TRUE(lane.TryPost(Task([&runs] { ++runs; }))) << "the place of what was given up is free";
    EXPECT_FALSE(lane.TryPost(Task([&runs] { ++runs; })));
    plug.Release();
  }
  EXPECT_EQ(runs, 2);
}

TEST(Lane, CancellingFreesTheWorksMemoryAtOnce) {
  Lane lane({.num_threads = 1});
  Plug plug(lane);
  auto held = std::make_shared<int>(7);
  const auto task = Task([held] { ADD_FAILURE() << *held; });
  ASSERT_TRUE(lane.TryPost(task));
  EXPECT_EQ(held.use_count(), 2);
  EXPECT_TRUE(task->GiveUp());
  EXPECT_EQ(held.use_count(), 1);
  plug.Release();
}

TEST(Lane, RunningWorkCannotBeCancelled) {
  std::promise<void> begun, release;
  Lane lane({.num_threads = 1});
  const auto task = Task([&] {
    begun.set_value();
    release.get_future().wait();
  });
  ASSERT_TRUE(lane.TryPost(task));
  begun.get_future().wait();
  EXPECT_FALSE(task->GiveUp());
  release.set_value();
}

TEST(Lane, SharesItemsWithIdleThreads) {
  Lane lane({.num_threads = 3});
  std::atomic<int> arrived = 0;
  std::array<std::atomic<int>, 100> times{};
  lane.Share(times.size(), [&](std::size_t i) {
    // The first two end together only if two threads run them.
    ++arrived;
    EXPECT_TRUE(i >= 2 || testing::Eventually([&] { return arrived >= 2; }));
    ++times[i];
  });
  for (const std::atomic<int>& n : times) EXPECT_EQ(n, 1);
  lane.Share(0, [](std::size_t) { FAIL(); });
}

TEST(Lane, ABusyLaneLeavesAllToTheCaller) {
  Lane lane({.num_threads = 2});
  std::promise<void> may_go_on;
  std::shared_future<void> go = may_go_on.get_future().share();
  for (int i = 0; i < 2; ++i) lane.Post([go] { go.wait(); });
  std::set<std::thread::id> threads;
  lane.Share(50, [&](std::size_t) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
  may_go_on.set_value();
}

TEST(Lane, AnItemsExceptionReachesTheCallerAfterTheOthersHaveEnded) {
  Lane lane({.num_threads = 3});
  for (int round = 0; round < 100; ++round) {
    std::atomic<int> begun = 0, ended = 0;
    const auto body = [&](std::size_t i) {
      ++begun;
      if (i == 5) throw std::runtime_error("item 5");
      ++ended;
    };
    EXPECT_THROW(lane.Share(10'000, body), std::runtime_error);
    EXPECT_EQ(ended + 1, begun);
  }
}

TEST(Lane, ItemsNotStartedWhenOneThrowsAreSkipped) {
  Lane lane({.num_threads = 1});  // helps no other thread: the caller runs its items in turn
  int begun = 0;
  const auto body = [&](std::size_t i) {
    ++begun;
    if (i == 5) throw std::runtime_error("item 5");
  };
  EXPECT_THROW(lane.Share(10'000, body), std::runtime_error);
  EXPECT_EQ(begun, 6);
}

TEST(Lane, SurvivesExceptionsOfItsTasks) {
  std::vector<std::string> told;
  std::vector<int> order;
  const auto held = std::make_shared<int>(7);
  {
    Lane lane({.num_threads = 1, .on_exception = [&told](const char* what) { told.emplace_back(what); }});
    Plug plug(lane);
    lane.Post([&order, held] {
      order.push_back(0);
      throw std::runtime_error("task 0");
    });
    ASSERT_TRUE(lane.TryPost(Task([] { throw 1; })));
    ASSERT_TRUE(lane.TryPostLast(Task([] { throw std::bad_alloc(); })));
    lane.Post([&order] { order.push_back(1); });
    plug.Release();
    EXPECT_TRUE(testing::Eventually([&held] { return held.use_count() == 1; })) << "what it held is freed";
    lane.Post([&order] { order.push_back(2); });
  }
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(told, (std::vector<std::string>{"task 0", "an exception of an unknown type", "std::bad_alloc"}));
}

TEST(Lane, KeepsAllItsThreadsAfterExceptions) {
  constexpr int kThreads = 3;
  std::atomic<int> arrived = 0;
  Lane lane({.num_threads = kThreads, .on_exception = [](const char*) { throw std::bad_alloc(); }});
  for (int i = 0; i < 2 * kThreads; ++i) lane.Post([] { throw std::runtime_error("as meant by the test"); });
  for (int i = 0; i < kThreads; ++i) {
    lane.Post([&] {
      // They end together only if each has its own thread.
      ++arrived;
      EXPECT_TRUE(testing::Eventually([&] { return arrived == kThreads; }));
    });
  }
}

TEST(Lane, ItsThreadsHaveTheRequestedNiceness) {
  const int here = getpriority(PRIO_PROCESS, 0);
  std::promise<int> there;
  Lane lane({.num_threads = 1, .niceness = 3});
  lane.Post([&there] { there.set_value(getpriority(PRIO_PROCESS, 0)); });
  EXPECT_EQ(there.get_future().get(), std::min(here + 3, 19));
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), here) << "of that thread only";
}

TEST(Lane, EndsAfterThePostedTasks) {
  std::atomic<int> runs = 0;
  {
    Lane lane({.num_threads = 3});
    for (int i = 0; i < 100; ++i) lane.Post([&runs] { ++runs; });
  }
  EXPECT_EQ(runs, 100);
}

}  // namespace
}  // namespace dhpmap

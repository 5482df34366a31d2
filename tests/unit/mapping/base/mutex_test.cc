// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/base/mutex.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace dhpmap {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;

static_assert(sizeof(Mutex) == sizeof(std::mutex) && sizeof(CondVar) == sizeof(std::condition_variable));

/// Whether a thread other than the caller's could take the mutex.
bool IsFree(Mutex& mutex) {
  bool taken = false;
  std::thread([&mutex, &taken] {
    if (!mutex.TryLock()) return;
    taken = true;
    mutex.Unlock();
  }).join();
  return taken;
}

TEST(MutexLock, HoldsToTheEndOfTheScope) {
  Mutex mutex;
  {
    const MutexLock lock(mutex);
    EXPECT_FALSE(IsFree(mutex));
  }
  EXPECT_TRUE(IsFree(mutex));
}

TEST(MutexLock, LetsGoAndTakesAgain) {
  Mutex mutex;
  MutexLock lock(mutex);
  lock.Unlock();
  EXPECT_TRUE(IsFree(mutex));
  lock.Lock();
  EXPECT_FALSE(IsFree(mutex));
}

/// A lock that let go ends while the mutex is held otherwise, which the analysis takes for a mistake.
bool EndOfScopeLeavesAlone(Mutex& mutex) DHPMAP_NO_THREAD_SAFETY_ANALYSIS {
  {
    MutexLock lock(mutex);
    lock.Unlock();
    mutex.Lock();
  }
  const bool is_held = !IsFree(mutex);
  mutex.Unlock();
  return is_held;
}

TEST(MutexLock, ThatLetGoUnlocksNothingAtItsEnd) {
  Mutex mutex;
  EXPECT_TRUE(EndOfScopeLeavesAlone(mutex));
}

TEST(Mutex, LetsOneThreadInAtATime) {
  struct {
    Mutex mutex;
    int count DHPMAP_GUARDED_BY(mutex) = 0;
  } shared;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&shared] {
      for (int i = 0; i < 5000; ++i) {
        const MutexLock lock(shared.mutex);
        ++shared.count;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  const MutexLock lock(shared.mutex);
  EXPECT_EQ(shared.count, 20000);
}

/// Two threads that take turns: each waits for the other's move.
class TurnsOfTwo {
 public:
  void Play(int parity, int rounds) {
    for (int i = 0; i < rounds; ++i) {
      const MutexLock lock(mutex_);
      moved_.Wait(mutex_, [this, parity]() DHPMAP_REQUIRES(mutex_) { return moves_ % 2 == parity; });
      ++moves_;
      moved_.NotifyOne();
    }
  }
  int moves() {
    const MutexLock lock(mutex_);
    return moves_;
  }

 private:
  Mutex mutex_;
  CondVar moved_;
  int moves_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

TEST(CondVar, WakesWhoWaitsForACondition) {
  TurnsOfTwo turns;
  std::thread even([&turns] { turns.Play(0, 500); });
  turns.Play(1, 500);
  even.join();
  EXPECT_EQ(turns.moves(), 1000);
}

TEST(CondVar, LetsGoOfTheMutexWhileItWaitsAndHoldsItAfterwards) {
  Mutex mutex;
  CondVar changed;
  bool is_set = false;
  std::thread setter;
  {
    const MutexLock lock(mutex);
    setter = std::thread([&] {
      const MutexLock set(mutex);  // gets in only because the wait lets go
      is_set = true;
      changed.NotifyAll();
    });
    while (!is_set) changed.Wait(mutex);
    EXPECT_FALSE(IsFree(mutex));
  }
  setter.join();
  EXPECT_TRUE(IsFree(mutex));
}

TEST(CondVar, SaysThatTheTimeIsUp) {
  Mutex mutex;
  CondVar never;
  const MutexLock lock(mutex);
  const auto start = CondVar::Clock::now();
  EXPECT_FALSE(never.WaitFor(mutex, milliseconds(20), [] { return false; }));
  EXPECT_GE(CondVar::Clock::now() - start, milliseconds(20));
  while (never.WaitUntil(mutex, start)) continue;  // a time that has passed: returns, but for an early wake-up
  while (never.WaitFor(mutex, milliseconds(1))) continue;
  EXPECT_FALSE(IsFree(mutex));
}

TEST(CondVar, AsksTheConditionBeforeItWaitsAndOnceMoreWhenTheTimeIsUp) {
  Mutex mutex;
  CondVar never;
  const MutexLock lock(mutex);
  EXPECT_TRUE(never.WaitFor(mutex, minutes(10), [] { return true; }));
  int asked = 0;
  EXPECT_TRUE(never.WaitUntil(mutex, CondVar::Clock::now(), [&asked] { return ++asked > 1; }));
}

TEST(CondVar, WakesAllWhoWait) {
  Mutex mutex;
  CondVar changed;
  int waiting = 0;
  bool may_go = false;
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&] {
      const MutexLock lock(mutex);
      ++waiting;
      changed.NotifyAll();
      EXPECT_TRUE(changed.WaitFor(mutex, minutes(2), [&may_go] { return may_go; }));
    });
  }
  {
    const MutexLock lock(mutex);
    EXPECT_TRUE(changed.WaitFor(mutex, minutes(2), [&waiting] { return waiting == 3; }));
    may_go = true;
    changed.NotifyAll();
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace dhpmap

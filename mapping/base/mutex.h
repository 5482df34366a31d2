// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

// What guards what, in words that clang's -Wthread-safety checks (deploy/check.sh thread-safety) and GCC skips.
#if defined(__clang__)
#define DHPMAP_THREAD_ATTRIBUTE(x) __attribute__((x))
#else
#define DHPMAP_THREAD_ATTRIBUTE(x)
#endif

/// On a member: read and written only while the mutex is held.
#define DHPMAP_GUARDED_BY(mutex) DHPMAP_THREAD_ATTRIBUTE(guarded_by(mutex))
/// On a pointer: what it points to is read and written only while the mutex is held; the pointer itself is free.
#define DHPMAP_PT_GUARDED_BY(mutex) DHPMAP_THREAD_ATTRIBUTE(pt_guarded_by(mutex))
/// On a function, or a lambda after its parameters: called with the mutexes held, which are still held when it returns.
#define DHPMAP_REQUIRES(...) DHPMAP_THREAD_ATTRIBUTE(requires_capability(__VA_ARGS__))
/// On a function: called without the mutexes, because it takes them itself.
#define DHPMAP_EXCLUDES(...) DHPMAP_THREAD_ATTRIBUTE(locks_excluded(__VA_ARGS__))
/// On a function: returns with the mutexes held. Without arguments: the object itself.
#define DHPMAP_ACQUIRE(...) DHPMAP_THREAD_ATTRIBUTE(acquire_capability(__VA_ARGS__))
/// On a function: called with the mutexes held, returns without. Without arguments: the object itself.
#define DHPMAP_RELEASE(...) DHPMAP_THREAD_ATTRIBUTE(release_capability(__VA_ARGS__))
/// On a function: holds the mutex (by default the object itself) if it returned `result`.
#define DHPMAP_TRY_ACQUIRE(...) DHPMAP_THREAD_ATTRIBUTE(try_acquire_capability(__VA_ARGS__))
/// On a function that returns a reference to the mutex.
#define DHPMAP_RETURNS_MUTEX(mutex) DHPMAP_THREAD_ATTRIBUTE(lock_returned(mutex))
/// On a mutex: whoever takes both takes this one first (checked by clang only with -Wthread-safety-beta).
#define DHPMAP_ACQUIRED_BEFORE(...) DHPMAP_THREAD_ATTRIBUTE(acquired_before(__VA_ARGS__))
/// On a function that is right for a reason that the analysis cannot see; the reason stands beside it.
#define DHPMAP_NO_THREAD_SAFETY_ANALYSIS DHPMAP_THREAD_ATTRIBUTE(no_thread_safety_analysis)

namespace dhpmap {

/// std::mutex that the analysis knows. Not recursive. Take it with a MutexLock; Lock and Unlock are for what a scope
/// cannot say, such as a function that REQUIRES the mutex and lets go of it while it works.
class DHPMAP_THREAD_ATTRIBUTE(capability("mutex")) Mutex {
 public:
  Mutex() = default;
  Mutex(const Mutex&) = delete;
  Mutex& operator=(const Mutex&) = delete;

  void Lock() DHPMAP_ACQUIRE() { mutex_.lock(); }
  void Unlock() DHPMAP_RELEASE() { mutex_.unlock(); }
  [[nodiscard]] bool TryLock() DHPMAP_TRY_ACQUIRE(true) { return mutex_.try_lock(); }

 private:
  friend class CondVar;
  std::mutex mutex_;
};

/// Holds a mutex from here to the end of the scope. Unlock and Lock give it up and take it again in between, each only
/// in its turn. Belongs to one thread.
class DHPMAP_THREAD_ATTRIBUTE(scoped_lockable) MutexLock {
 public:
  explicit MutexLock(Mutex& mutex) DHPMAP_ACQUIRE(mutex) : mutex_(mutex) { mutex_.Lock(); }
  ~MutexLock() DHPMAP_RELEASE() {
    if (is_held_) mutex_.Unlock();
  }
  MutexLock(const MutexLock&) = delete;
  MutexLock& operator=(const MutexLock&) = delete;

  void Unlock() DHPMAP_RELEASE() {
    is_held_ = false;
    mutex_.Unlock();
  }
  void Lock() DHPMAP_ACQUIRE() {
    mutex_.Lock();
    is_held_ = true;
  }

 private:
  Mutex& mutex_;
  bool is_held_ = true;  // the compiler drops it where nobody calls Unlock
};

/// std::condition_variable over a Mutex. Every wait is called with the mutex held, lets go of it while it sleeps, and
/// holds it again when it returns. All waiters at one time use the same mutex. Waits without a condition may return
/// early, so they stand in a loop; a condition is called with the mutex held, and a lambda says so:
///     wake_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !tasks_.empty(); });
/// Times are of the steady clock, so that setting the system's clock neither ends nor prolongs a wait.
class CondVar {
 public:
  using Clock = std::chrono::steady_clock;

  CondVar() = default;
  CondVar(const CondVar&) = delete;
  CondVar& operator=(const CondVar&) = delete;

  void NotifyOne() { condition_.notify_one(); }
  void NotifyAll() { condition_.notify_all(); }

  void Wait(Mutex& mutex) DHPMAP_REQUIRES(mutex) {
    std::unique_lock<std::mutex> held(mutex.mutex_, std::adopt_lock);
    condition_.wait(held);
    held.release();
  }

  /// False if it ended because `end` has come.
  bool WaitUntil(Mutex& mutex, Clock::time_point end) DHPMAP_REQUIRES(mutex) {
    std::unique_lock<std::mutex> held(mutex.mutex_, std::adopt_lock);
    const std::cv_status status = condition_.wait_until(held, end);
    held.release();
    return status == std::cv_status::no_timeout;
  }

  /// False if it ended because the time was up. `time` is years at most: now and it must fit in the clock.
  bool WaitFor(Mutex& mutex, Clock::duration time) DHPMAP_REQUIRES(mutex) {
    return WaitUntil(mutex, Clock::now() + time);
  }

  // With a condition. The analysis cannot see that its mutex is the `mutex` given here: where the condition is written,
  // it checks both.

  template <typename Condition>
  void Wait(Mutex& mutex, Condition holds) DHPMAP_REQUIRES(mutex) DHPMAP_NO_THREAD_SAFETY_ANALYSIS {
    while (!holds()) Wait(mutex);
  }

  /// Whether the condition holds, which may be so although `end` has come.
  template <typename Condition>
  bool WaitUntil(Mutex& mutex, Clock::time_point end, Condition holds)
      DHPMAP_REQUIRES(mutex) DHPMAP_NO_THREAD_SAFETY_ANALYSIS {
    while (!holds()) {
      if (!WaitUntil(mutex, end)) return holds();
    }
    return true;
  }

  /// Whether the condition holds, which may be so although the time is up.
  template <typename Condition>
  bool WaitFor(Mutex& mutex, Clock::duration time, Condition holds)
      DHPMAP_REQUIRES(mutex) DHPMAP_NO_THREAD_SAFETY_ANALYSIS {
    return WaitUntil(mutex, Clock::now() + time, holds);
  }

 private:
  std::condition_variable condition_;
};

}  // namespace dhpmap

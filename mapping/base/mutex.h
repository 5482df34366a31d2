// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

// Lock annotations, checked by clang's -Wthread-safety (deploy/check.sh thread-safety) and ignored by GCC.
#if defined(__clang__)
#define DHPMAP_THREAD_ATTRIBUTE(x) __attribute__((x))
#else
#define DHPMAP_THREAD_ATTRIBUTE(x)
#endif

/// On a member: read and written only while the mutex is held.
#define DHPMAP_GUARDED_BY(mutex) DHPMAP_THREAD_ATTRIBUTE(guarded_by(mutex))
/// On a pointer: its target is read and written only while the mutex is held; the pointer itself is free.
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
/// On a mutex: locked before the other if both are taken (clang checks it only with -Wthread-safety-beta).
#define DHPMAP_ACQUIRED_BEFORE(...) DHPMAP_THREAD_ATTRIBUTE(acquired_before(__VA_ARGS__))
/// On a function that is correct for a reason that the analysis cannot see; a comment gives the reason.
#define DHPMAP_NO_THREAD_SAFETY_ANALYSIS DHPMAP_THREAD_ATTRIBUTE(no_thread_safety_analysis)

namespace dhpmap {

/// std::mutex with annotations. Not recursive. Use a MutexLock; Lock and Unlock are for code that scopes cannot
/// express, such as a function that REQUIRES the mutex and releases it while it works.
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

/// Holds a mutex until the end of the scope. Unlock and Lock release and retake it in between, alternately. One thread.
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
  bool is_held_ = true;  // optimised away unless Unlock is called
};

/// std::condition_variable over a Mutex. Every wait is called with the mutex held, releases it while sleeping, and
/// holds it on return. Concurrent waiters use the same mutex. Waits without a condition may wake spuriously, so put
/// them in a loop. A condition runs with the mutex held, and a lambda says so:
///     wake_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return stopping_ || !tasks_.empty(); });
/// Times are of the steady clock, so adjusting the system clock does not affect waits.
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

  /// False if it returned because of `end`.
  bool WaitUntil(Mutex& mutex, Clock::time_point end) DHPMAP_REQUIRES(mutex) {
    std::unique_lock<std::mutex> held(mutex.mutex_, std::adopt_lock);
    const std::cv_status status = condition_.wait_until(held, end);
    held.release();
    return status == std::cv_status::no_timeout;
  }

  /// False on timeout. `time` must not overflow the clock: at most years.
  bool WaitFor(Mutex& mutex, Clock::duration time) DHPMAP_REQUIRES(mutex) {
    return WaitUntil(mutex, Clock::now() + time);
  }

  // With a condition. The analysis cannot see that the condition's mutex is `mutex`; it checks both at the call.

  template <typename Condition>
  void Wait(Mutex& mutex, Condition holds) DHPMAP_REQUIRES(mutex) DHPMAP_NO_THREAD_SAFETY_ANALYSIS {
    while (!holds()) Wait(mutex);
  }

  /// Whether the condition holds, possibly after `end`.
  template <typename Condition>
  bool WaitUntil(Mutex& mutex, Clock::time_point end, Condition holds)
      DHPMAP_REQUIRES(mutex) DHPMAP_NO_THREAD_SAFETY_ANALYSIS {
    while (!holds()) {
      if (!WaitUntil(mutex, end)) return holds();
    }
    return true;
  }

  /// Whether the condition holds, possibly after the timeout.
  template <typename Condition>
  bool WaitFor(Mutex& mutex, Clock::duration time, Condition holds)
      DHPMAP_REQUIRES(mutex) DHPMAP_NO_THREAD_SAFETY_ANALYSIS {
    return WaitUntil(mutex, Clock::now() + time, holds);
  }

 private:
  std::condition_variable condition_;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// A FIFO mutex: a thread that unlocks and locks again queues behind the waiting ones. For critical sections of
/// milliseconds, because each handover wakes a thread. Not recursive.
class DHPMAP_THREAD_ATTRIBUTE(capability("mutex")) FairMutex {
 public:
  FairMutex() = default;
  FairMutex(const FairMutex&) = delete;
  FairMutex& operator=(const FairMutex&) = delete;

  void Lock() DHPMAP_ACQUIRE() {
    const MutexLock lock(mutex_);
    const std::uint64_t number = next_++;
    turn_.Wait(mutex_, [&]() DHPMAP_REQUIRES(mutex_) { return number == present_; });
  }
  void Unlock() DHPMAP_RELEASE() {
    const MutexLock lock(mutex_);
    ++present_;
    turn_.NotifyAll();
  }

  /// Threads that hold it or wait for it.
  [[nodiscard]] std::uint64_t num_in_line() {
    const MutexLock lock(mutex_);
    return next_ - present_;
  }

 private:
  Mutex mutex_;
  CondVar turn_;
  std::uint64_t next_ DHPMAP_GUARDED_BY(mutex_) = 0;     ///< ticket of the next caller
  std::uint64_t present_ DHPMAP_GUARDED_BY(mutex_) = 0;  ///< ticket of the holder
};

/// Holds it until the end of the scope.
class DHPMAP_THREAD_ATTRIBUTE(scoped_lockable) FairMutexLock {
 public:
  explicit FairMutexLock(FairMutex& mutex) DHPMAP_ACQUIRE(mutex) : mutex_(mutex) { mutex_.Lock(); }
  ~FairMutexLock() DHPMAP_RELEASE() { mutex_.Unlock(); }
  FairMutexLock(const FairMutexLock&) = delete;
  FairMutexLock& operator=(const FairMutexLock&) = delete;

 private:
  FairMutex& mutex_;
};

}  // namespace dhpmap

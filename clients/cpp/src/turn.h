// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "mapping/base/mutex.h"

namespace dhpmap::client {

/// A mutex whose Take has a deadline. Thread-safe.
class OneAtATime {
 public:
  using Clock = std::chrono::steady_clock;

  /// False if it was not free by `end`.
  [[nodiscard]] bool Take(Clock::time_point end) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    const auto is_free = [this]() DHPMAP_REQUIRES(mutex_) { return !is_taken_; };
    if (!is_free() && !free_.WaitUntil(mutex_, end, is_free)) return false;
    is_taken_ = true;
    return true;
  }
  void GiveBack() DHPMAP_EXCLUDES(mutex_) {
    {
      const MutexLock lock(mutex_);
      is_taken_ = false;
    }
    free_.NotifyAll();
  }

 private:
  Mutex mutex_;
  CondVar free_;
  bool is_taken_ DHPMAP_GUARDED_BY(mutex_) = false;
};

/// A turn, returned on destruction.
class Turn {
 public:
  Turn(OneAtATime& turns, OneAtATime::Clock::time_point end) : turns_(turns), is_ours_(turns.Take(end)) {}
  ~Turn() {
    if (is_ours_) turns_.GiveBack();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  [[nodiscard]] bool is_ours() const { return is_ours_; }

 private:
  OneAtATime& turns_;
  const bool is_ours_;
};

}  // namespace dhpmap::client

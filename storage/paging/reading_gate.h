// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"

namespace dhpmap {

/// Lets readers in until it is closed, which waits for those that are inside. Thread-safe.
class ReadingGate {
 public:
  /// Counts a reader as inside during its lifetime.
  class Visit {
   public:
    explicit Visit(ReadingGate& gate) : gate_(gate) {}
    ~Visit() {
      const MutexLock lock(gate_.mutex_);
      if (--gate_.num_inside_ == 0) gate_.is_empty_.NotifyAll();
    }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

   private:
    ReadingGate& gate_;
  };

  /// Counts the caller as inside: hand it to a Visit. UNAVAILABLE once it is closed; `name`: of what is read.
  Status Enter(const std::string& name) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    if (is_closed_) return Unavailable(name + " cannot be read any more: the store is closed");
    ++num_inside_;
    return Status::Ok();
  }
  void Close() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    is_closed_ = true;
    is_empty_.Wait(mutex_, [this]() DHPMAP_REQUIRES(mutex_) { return num_inside_ == 0; });
  }

 private:
  Mutex mutex_;
  CondVar is_empty_;
  int num_inside_ DHPMAP_GUARDED_BY(mutex_) = 0;
  bool is_closed_ DHPMAP_GUARDED_BY(mutex_) = false;
};

}  // namespace dhpmap

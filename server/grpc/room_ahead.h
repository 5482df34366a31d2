// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "mapping/base/mutex.h"
#include "server/base/byte_budget.h"

namespace dhpmap {

/// The memory of a stream's present message, and room reserved for its next one. A stream that was refused for lack of
/// memory reserves room before it reads on, so that the bytes read never exceed the budget. A stream has one message at
/// a time. Thread-safe.
class RoomAhead {
 public:
  explicit RoomAhead(std::shared_ptr<ByteBudget> budget) : budget_(std::move(budget)), share_(budget_.get()) {}

  /// Reserves room for the next message, at most the whole budget. False, and nothing is held, if that much is not
  /// free.
  [[nodiscard]] bool Take(std::size_t bytes) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    is_used_ = false;
    if (share_.Resize(std::min(bytes, budget_->limit_bytes()))) return true;
    share_.Release();
    return false;
  }
  /// The message has arrived and takes this much. False, and nothing is held, if that much is not free.
  [[nodiscard]] bool Use(std::size_t bytes) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    is_used_ = true;
    if (share_.Resize(bytes)) return true;
    share_.Release();
    return false;
  }
  /// Releases the room reserved for a message that has not come. No effect once it has arrived.
  void GiveBackUnused() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    if (!is_used_) share_.Release();
  }
  /// The message is freed.
  void Release() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    share_.Release();
  }
  [[nodiscard]] std::size_t bytes() const DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    return share_.bytes();
  }

 private:
  const std::shared_ptr<ByteBudget> budget_;
  mutable Mutex mutex_;
  ByteShare share_ DHPMAP_GUARDED_BY(mutex_);
  bool is_used_ DHPMAP_GUARDED_BY(mutex_) = false;
};

}  // namespace dhpmap

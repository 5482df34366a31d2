// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "mapping/base/mutex.h"
#include "server/base/byte_budget.h"

namespace dhpmap {

/// What the present message of a stream takes of a budget, and room for the next one before it is there: who was
/// refused for want of room reads on only with room in hand, so that what is read is no longer more than what may be. A
/// stream has one message at a time. Thread-safe.
class RoomAhead {
 public:
  explicit RoomAhead(std::shared_ptr<ByteBudget> budget) : budget_(std::move(budget)), share_(budget_.get()) {}

  /// Room for a message that is not there yet; all there is for one that is larger. False, and nothing is held, if
  /// there is not so much now.
  [[nodiscard]] bool Take(std::size_t bytes) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    is_used_ = false;
    if (share_.Resize(std::min(bytes, budget_->limit_bytes()))) return true;
    share_.Release();
    return false;
  }
  /// The message is there, and takes so much by now. False, and nothing is held, if there is not so much.
  [[nodiscard]] bool Use(std::size_t bytes) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    is_used_ = true;
    if (share_.Resize(bytes)) return true;
    share_.Release();
    return false;
  }
  /// Gives back what was taken for a message that has not come; without effect on one that is there.
  void GiveBackUnused() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    if (!is_used_) share_.Release();
  }
  /// The message is gone.
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "mapping/base/mutex.h"

namespace dhpmap {

/// Limits the concurrent refinements of all maps of a process: each takes a thread and some hundred MB of scratch
/// memory. Thread-safe.
class RefinementSlots {
 public:
  /// One slot; its destructor returns it, on any thread.
  class Slot {
   public:
    ~Slot() {
      if (slots_ != nullptr) slots_->GiveBack();
    }
    Slot(Slot&& other) noexcept : slots_(std::exchange(other.slots_, nullptr)) {}
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;
    Slot& operator=(Slot&&) = delete;

   private:
    friend class RefinementSlots;
    explicit Slot(std::shared_ptr<RefinementSlots> slots) : slots_(std::move(slots)) {}
    std::shared_ptr<RefinementSlots> slots_;
  };

  explicit RefinementSlots(int count) : num_free_(count) {}

  /// Empty if no slot is free.
  static std::optional<Slot> TryTake(const std::shared_ptr<RefinementSlots>& slots);
  /// Waits for a slot; empty once `is_cancelled`, if set and polled many times a second, returns true.
  static std::optional<Slot> Take(const std::shared_ptr<RefinementSlots>& slots,
                                  const std::function<bool()>& is_cancelled);

 private:
  void GiveBack() DHPMAP_EXCLUDES(mutex_);

  Mutex mutex_;
  CondVar is_free_;
  int num_free_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/refinement_slots.h"

#include <chrono>

namespace dhpmap {
namespace {

constexpr std::chrono::milliseconds kBetweenQuestions{20};

}  // namespace

std::optional<RefinementSlots::Slot> RefinementSlots::TryTake(const std::shared_ptr<RefinementSlots>& slots) {
  const MutexLock lock(slots->mutex_);
  if (slots->num_free_ == 0) return std::nullopt;
  --slots->num_free_;
  return Slot(slots);
}

std::optional<RefinementSlots::Slot> RefinementSlots::Take(const std::shared_ptr<RefinementSlots>& slots,
                                                           const std::function<bool()>& is_cancelled) {
  const MutexLock lock(slots->mutex_);
  while (slots->num_free_ == 0) {
    if (is_cancelled && is_cancelled()) return std::nullopt;
    slots->is_free_.WaitFor(slots->mutex_, kBetweenQuestions);
  }
  --slots->num_free_;
  return Slot(slots);
}

void RefinementSlots::GiveBack() {
  const MutexLock lock(mutex_);
  ++num_free_;
  is_free_.NotifyOne();
}

}  // namespace dhpmap

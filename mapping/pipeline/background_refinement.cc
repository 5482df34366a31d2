// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/background_refinement.h"

#include <chrono>
#include <exception>
#include <utility>

#include "mapping/base/free_memory.h"
#include "mapping/base/this_thread.h"

namespace dhpmap {
namespace {

/// Nobody waits for a refinement on the side: where cores are scarce, frames and answers come first.
constexpr int kNiceness = 10;

}  // namespace

BackgroundRefinement::~BackgroundRefinement() { Cancel(); }

void BackgroundRefinement::Start(std::shared_ptr<const MapSnapshot> before,
                                 std::shared_ptr<const StateMarks> refined_before,
                                 std::optional<RefinementSlots::Slot> slot) {
  is_cancelled_ = false;
  outcome_ = std::async(
      std::launch::async,
      [this, before = std::move(before), refined_before = std::move(refined_before), slot = std::move(slot)]() mutable {
        NameThisThread("refinement");
        MakeThisThreadNicer(kNiceness);
        const auto held = std::move(slot);  // until the end of the work, not of the outcome
        ThreadPool pool(1);                 // the other cores go on fusing
        Map map(before);
        Outcome outcome{.before = before};
        outcome.report = RefineMap(map, pool, refined_before.get(), [this] { return is_cancelled_.load(); });
        outcome.refined = map.Freeze();
        outcome.marks = std::make_shared<const StateMarks>(*outcome.refined);
        GiveBackFreeMemory();
        return outcome;
      });
}

bool BackgroundRefinement::IsReady() const {
  return outcome_.valid() && outcome_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::optional<BackgroundRefinement::Outcome> BackgroundRefinement::Take() {
  try {
    return outcome_.get();
  } catch (const std::exception&) {
    return std::nullopt;  // nothing is lost: the next refinement finds the same voxels
  }
}

void BackgroundRefinement::Cancel() {
  if (!outcome_.valid()) return;
  is_cancelled_ = true;
  (void)Take();
}

}  // namespace dhpmap

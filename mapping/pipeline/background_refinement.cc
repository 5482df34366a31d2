// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/background_refinement.h"

#include <chrono>
#include <exception>
#include <functional>
#include <utility>

#include "mapping/base/free_memory.h"
#include "mapping/base/this_thread.h"

namespace dhpmap {
namespace {

/// Nobody waits for a background refinement: where cores are scarce, frames and queries come first.
constexpr int kNiceness = 10;

BackgroundRefinement::Outcome Refine(std::shared_ptr<const MapSnapshot> before, RefinementRound round, int most_steps,
                                     const std::function<bool()>& is_cancelled) {
  ThreadPool pool(1);  // the other cores continue fusing
  round.Begin(*before, most_steps);
  const auto marks = round.pending().marks();
  const RegionPart part = round.NextPart();
  Map map = GoOnFrom(*before, part);
  before = nullptr;
  BackgroundRefinement::Outcome outcome;
  outcome.report = round.RefineNext(map, pool, is_cancelled);
  const auto refined = map.Freeze();
  outcome.changes = OutcomeOf(marks, *refined, part);
  round.End(*refined, part);
  outcome.round = std::move(round);
  return outcome;
}

}  // namespace

BackgroundRefinement::~BackgroundRefinement() { Cancel(); }

void BackgroundRefinement::Start(std::shared_ptr<const MapSnapshot> before, RefinementRound round, int most_steps,
                                 std::optional<RefinementSlots::Slot> slot) {
  is_cancelled_ = false;
  outcome_ = std::async(std::launch::async, [this, before = std::move(before), round = std::move(round), most_steps,
                                             slot = std::move(slot)]() mutable {
    NameThisThread("refinement");
    MakeThisThreadNicer(kNiceness);
    const auto held = std::move(slot);  // held until the work ends, not the outcome; so is the state
    Outcome outcome = Refine(std::move(before), std::move(round), most_steps, [this] { return is_cancelled_.load(); });
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
    return std::nullopt;  // nothing is lost: the next refinement processes the same voxels
  }
}

void BackgroundRefinement::Cancel() {
  if (!outcome_.valid()) return;
  is_cancelled_ = true;
  (void)Take();
}

}  // namespace dhpmap

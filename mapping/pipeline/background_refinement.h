// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <optional>

#include "mapping/map/map.h"
#include "mapping/pipeline/refinement_slots.h"
#include "mapping/refinement/adopt_refinement.h"
#include "mapping/refinement/refine_map.h"
#include "mapping/refinement/refinement_round.h"

namespace dhpmap {

/// Refines a frozen state of the map on a thread of its own while mapping goes on. Thread-compatible: one owner.
class BackgroundRefinement {
 public:
  struct Outcome {
    RefinementOutcome changes;
    RefinementReport report;
    RefinementRound round;  ///< what is left of it
  };

  BackgroundRefinement() = default;
  /// Cancel().
  ~BackgroundRefinement();
  BackgroundRefinement(const BackgroundRefinement&) = delete;
  BackgroundRefinement& operator=(const BackgroundRefinement&) = delete;

  /// The next step of `round`, which has `most_steps` if this is its first. Requires that none is under way. The
  /// slot, if there is one, is given back when the step has ended, and so is the state: the outcome does not keep it.
  void Start(std::shared_ptr<const MapSnapshot> before, RefinementRound round, int most_steps,
             std::optional<RefinementSlots::Slot> slot = std::nullopt);
  [[nodiscard]] bool IsUnderWay() const { return outcome_.valid(); }
  [[nodiscard]] bool IsReady() const;
  /// Waits for the outcome; empty if it failed, such as for want of memory. Requires that one is under way.
  std::optional<Outcome> Take();
  /// Throws away what is under way; waits until its thread has ended, which is soon.
  void Cancel();

 private:
  std::future<Outcome> outcome_;
  std::atomic<bool> is_cancelled_ = false;
};

}  // namespace dhpmap

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

/// Refines a frozen state of the map on its own thread while mapping continues. Thread-compatible: one owner.
class BackgroundRefinement {
 public:
  struct Outcome {
    RefinementOutcome changes;
    RefinementReport report;
    RefinementRound round;  ///< its remaining regions
  };

  BackgroundRefinement() = default;
  /// As Cancel().
  ~BackgroundRefinement();
  BackgroundRefinement(const BackgroundRefinement&) = delete;
  BackgroundRefinement& operator=(const BackgroundRefinement&) = delete;

  /// Starts the next step of `round`; if it is the first, divides the round into at most `most_steps`. Requires that no
  /// step is running. Slot and state are released when the step ends; the outcome does not keep the state.
  void Start(std::shared_ptr<const MapSnapshot> before, RefinementRound round, int most_steps,
             std::optional<RefinementSlots::Slot> slot = std::nullopt);
  [[nodiscard]] bool IsUnderWay() const { return outcome_.valid(); }
  [[nodiscard]] bool IsReady() const;
  /// Waits for the outcome; empty if the step failed, for example for lack of memory. Requires a running step.
  std::optional<Outcome> Take();
  /// Discards a running step; waits until its thread has ended, which is soon.
  void Cancel();

 private:
  std::future<Outcome> outcome_;
  std::atomic<bool> is_cancelled_ = false;
};

}  // namespace dhpmap

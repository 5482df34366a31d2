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

namespace dhpmap {

/// Refines a frozen state of the map on a thread of its own while mapping goes on. Thread-compatible: one owner.
class BackgroundRefinement {
 public:
  struct Outcome {
    RefinementOutcome changes;
    std::shared_ptr<const StateMarks> marks;  ///< of the refined state
    RefinementReport report;
  };

  BackgroundRefinement() = default;
  /// Cancel().
  ~BackgroundRefinement();
  BackgroundRefinement(const BackgroundRefinement&) = delete;
  BackgroundRefinement& operator=(const BackgroundRefinement&) = delete;

  /// Requires that none is under way. `refined_before` may be null, see RefineLabels. The slot, if there is one, is
  /// given back when the refinement has ended, and so is the state: the outcome does not keep it.
  void Start(std::shared_ptr<const MapSnapshot> before, std::shared_ptr<const StateMarks> refined_before,
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

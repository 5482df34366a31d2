// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/refinement/pending_cubes.h"
#include "mapping/refinement/refine_map.h"

namespace dhpmap {

/// Refines a map region by region while mapping continues. Each step starts from the newest state, so only blocks
/// written during one step are in memory twice, and regions without writes since their last turn cost nothing. A round
/// processes everything that was pending at its beginning, then stray voxels, which need whole things. Copyable: a
/// failed or cancelled step is repeated from a copy. Thread-compatible.
class RefinementRound {
 public:
  /// Starts with nothing refined.
  RefinementRound() = default;
  /// Continues from a state with `pending` cubes left.
  explicit RefinementRound(PendingCubes pending) : pending_(std::move(pending)) {}

  /// Between two rounds.
  [[nodiscard]] bool IsFinished() const { return regions_.empty() && !are_strays_left_; }
  [[nodiscard]] const PendingCubes& pending() const { return pending_; }

  /// Records changes of `state`. Between rounds, begins a new one of at most `most_steps` regions with at least
  /// `least_blocks` blocks each: with fewer than some hundred blocks, the rim of a region costs as much as the region.
  void Begin(const MapSnapshot& state, int most_steps, int least_blocks = 600);
  /// The part of the state passed to Begin that the next step needs; see GoOnFrom.
  [[nodiscard]] RegionPart NextPart() const;
  /// Refines the next region in `map`, which continues from that part; the last step of a round is for stray voxels.
  /// With a single region, one step does both. Does nothing without pending cubes.
  RefinementReport RefineNext(Map& map, ThreadPool& pool, const std::function<bool()>& is_cancelled = {});
  /// `refined` is `map` after RefineNext; `part` is the result of NextPart before it.
  void End(const MapSnapshot& refined, const RegionPart& part) { pending_.NoteRefined(refined, part); }

 private:
  /// Whether the next region and the stray voxels are one step.
  [[nodiscard]] bool IsOnlyStep() const { return regions_.size() == 1 && !have_strays_a_step_; }

  PendingCubes pending_;
  std::vector<RefinementRegion> regions_;  ///< remaining in this round, in reverse order
  bool are_strays_left_ = false;           ///< of this round
  bool have_strays_a_step_ = false;
  bool needs_all_ = false;  ///< the next step needs the whole map
  int rim_ = 0;
};

}  // namespace dhpmap

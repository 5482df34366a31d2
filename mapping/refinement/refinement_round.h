// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/refinement/pending_cubes.h"
#include "mapping/refinement/refine_map.h"

namespace dhpmap {

/// Refinement of a map that goes on meanwhile, region by region: each begins with the newest state, so that of an older
/// one only what is written during a region's time is in memory twice, and what nobody has written to since its last
/// turn costs nothing. A round does all that was pending when it began, then stray voxels, for which it needs whole
/// things. Copyable: a step that fails or is given up is made again from a copy. Thread-compatible.
class RefinementRound {
 public:
  /// Nothing was refined yet.
  RefinementRound() = default;
  /// Goes on after a state of which `pending` is left.
  explicit RefinementRound(PendingCubes pending) : pending_(std::move(pending)) {}

  /// Between two rounds.
  [[nodiscard]] bool IsFinished() const { return regions_.empty() && !are_strays_left_; }
  [[nodiscard]] const PendingCubes& pending() const { return pending_; }

  /// Notes what `state` has that is new; between rounds, begins one of at most `most_steps`, each of at least so many
  /// blocks: below some hundred a region's rim costs as much as itself.
  void Begin(const MapSnapshot& state, int most_steps, int least_blocks = 600);
  /// What the next step needs of the state that Begin was told of; see GoOnFrom.
  [[nodiscard]] RegionPart NextPart() const;
  /// Refines the next region in `map`, which goes on from that part; the last step of a round, stray voxels. Where
  /// there is one region, both at once. Nothing if there was nothing pending.
  RefinementReport RefineNext(Map& map, ThreadPool& pool, const std::function<bool()>& is_cancelled = {});
  /// What `map` is after RefineNext; `part` is what NextPart was before.
  void End(const MapSnapshot& refined, const RegionPart& part) { pending_.NoteRefined(refined, part); }

 private:
  /// The next region and the stray voxels are one step.
  [[nodiscard]] bool IsOnlyStep() const { return regions_.size() == 1 && !have_strays_a_step_; }

  PendingCubes pending_;
  std::vector<RefinementRegion> regions_;  ///< of this round, the last one first
  bool are_strays_left_ = false;           ///< of this round
  bool have_strays_a_step_ = false;
  bool needs_all_ = false;  ///< a step needs all of the map
  int rim_ = 0;
};

}  // namespace dhpmap

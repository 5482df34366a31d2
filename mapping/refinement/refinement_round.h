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
/// turn costs nothing. A round does all that was pending when it began, then stray voxels. Copyable: a step that fails
/// or is given up is made again from a copy. Thread-compatible.
class RefinementRound {
 public:
  /// Nothing was refined yet.
  RefinementRound() = default;
  /// Goes on after a state of which `pending` is left.
  explicit RefinementRound(PendingCubes pending) : pending_(std::move(pending)) {}

  /// Between two rounds.
  [[nodiscard]] bool IsFinished() const { return regions_.empty(); }
  [[nodiscard]] const PendingCubes& pending() const { return pending_; }

  /// Notes what `state` has that is new; between rounds, begins one of at most `most_regions` steps.
  void Begin(const MapSnapshot& state, int most_regions);
  /// Refines the next region in `map`, which goes on from the state that Begin was told of; the last step of a round,
  /// stray voxels, too. Nothing if there was nothing pending.
  RefinementReport RefineNext(Map& map, ThreadPool& pool, const std::function<bool()>& is_cancelled = {});
  /// What `map` is after RefineNext.
  void End(const MapSnapshot& refined) { pending_.NoteRefined(refined); }

 private:
  PendingCubes pending_;
  std::vector<RefinementRegion> regions_;  ///< of this round, the last one first
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "mapping/changes/state_marks.h"
#include "mapping/evidence/refinement_region.h"
#include "mapping/map/map.h"
#include "mapping/refinement/region_part.h"

namespace dhpmap {

/// Which cubes of a map have to be refined: those in or around which blocks were written or erased since they were
/// refined, or a submap has come to be refined (IsRefined), has ceased to be, or is gone. At first, all. Copying costs
/// some bytes a pending cube. Thread-compatible.
class PendingCubes {
 public:
  /// Adds what `now`, a later state of the map, has that the last one did not have. `rim`: how many blocks beyond a
  /// cube's side have a say in it.
  void Note(const MapSnapshot& now, int rim);
  /// The same without adding anything: what `refined` has that the last state did not have is refinement's own work.
  /// `refined` need have no blocks but those of `part`; elsewhere it is as the last state.
  void NoteRefined(const MapSnapshot& refined, const RegionPart& part = {});
  void Remove(std::span<const CubeIndex> cubes);

  [[nodiscard]] const std::set<CubeIndex>& cubes() const { return cubes_; }
  /// Of the last state; null before the first.
  [[nodiscard]] const std::shared_ptr<const StateMarks>& marks() const { return marks_; }

 private:
  std::set<CubeIndex> cubes_;
  std::shared_ptr<const StateMarks> marks_;
};

/// The pending cubes of a state in at most `most_regions` parts of about the same number of blocks, none of which is
/// made smaller than `least_blocks` by that. Cubes that hold nothing are in none. Cubes that are near each other are
/// mostly in the same one.
std::vector<RefinementRegion> CutRegions(const PendingCubes& pending, const MapSnapshot& state, int most_regions,
                                         int least_blocks);

}  // namespace dhpmap

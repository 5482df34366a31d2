// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/changes/state_marks.h"
#include "mapping/map/map.h"
#include "mapping/refinement/region_part.h"

namespace dhpmap {

/// What a refinement wrote to one submap, by block. All erased: the submap is no longer there.
struct RefinedSubmap {
  SubmapId id;
  std::vector<BlockEntry> written;  ///< as they are afterwards
  std::vector<BlockIndex> erased;
};

/// What a refinement on the side made of a state, without that state: while mapping goes on, each block of a state that
/// is kept is soon memory that only the state still needs.
struct RefinementOutcome {
  std::shared_ptr<const StateMarks> before;  ///< of the state that it began with
  std::vector<RefinedSubmap> written;        ///< by ascending id, also submaps of which no block differs
};

/// Tells what a refinement has written. `refined` must come from `part` of the state of `before` (see GoOnFrom).
RefinementOutcome OutcomeOf(std::shared_ptr<const StateMarks> before, const MapSnapshot& refined,
                            const RegionPart& part = {});

/// Brings what was refined on the side into the map that went on from the state that the refinement began with. Taken
/// position by position (one block index, all submaps): where no settled submap of that state was written since, the
/// refined state is taken; where one was, and where one that held or was given voxels is gone, is locked or was edited
/// since (SubmapInfo::edited_revision), everything stays as it is now, to be refined the next time. So each voxel keeps
/// exactly one of both states, and nothing observed is lost. What took no part in the refinement (IsRefined) is no
/// hindrance. Returns how many positions were left. Call it from the map's writer.
std::int64_t AdoptRefinement(const RefinementOutcome& outcome, Map& map);

}  // namespace dhpmap

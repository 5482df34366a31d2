// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/map/state_marks.h"

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

/// Tells what a refinement has written. `refined` must come from the state of `before` (see Map::Freeze).
RefinementOutcome OutcomeOf(std::shared_ptr<const StateMarks> before, const MapSnapshot& refined);

/// Brings what was refined on the side into the map that went on from the state that the refinement began with. Taken
/// position by position (one block index, all submaps): where no settled submap of that state was written since, the
/// refined state is taken; where one was, where one that the refinement gave voxels to is gone or has moved, everything
/// stays as it is now, to be refined the next time. So each voxel keeps exactly one of both states, and nothing
/// observed is lost. Returns how many positions were left.
std::int64_t AdoptRefinement(const RefinementOutcome& outcome, Map& map);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/changes/state_marks.h"
#include "mapping/map/map.h"
#include "mapping/refinement/region_part.h"

namespace dhpmap {

/// Blocks that a refinement wrote to one submap. If all are erased, the submap was removed.
struct RefinedSubmap {
  SubmapId id;
  std::vector<BlockEntry> written;  ///< their final content
  std::vector<BlockIndex> erased;
};

/// The result of a background refinement, without the state it started from: keeping that state would keep all blocks
/// in memory that mapping has replaced meanwhile.
struct RefinementOutcome {
  std::shared_ptr<const StateMarks> before;  ///< marks of the state that it started from
  std::vector<RefinedSubmap> written;        ///< by ascending id, including submaps without changed blocks
};

/// The blocks that a refinement has written. `refined` must derive from `part` of the state of `before` (see GoOnFrom).
RefinementOutcome OutcomeOf(std::shared_ptr<const StateMarks> before, const MapSnapshot& refined,
                            const RegionPart& part = {});

/// Merges a background refinement into the map, which mapping has changed meanwhile. Decides by position (one block
/// index, all submaps): the refined state is taken if no inactive submap of the old state was written there since.
/// Otherwise, and if a submap that held or received voxels there was removed, locked or edited since
/// (SubmapInfo::edited_revision), the present state stays until the next refinement. Each voxel thus keeps exactly one
/// of both states, and no observation is lost. Submaps that are not refined (IsRefined) do not matter. Returns how many
/// positions were left. Call it from the map's writer.
std::int64_t AdoptRefinement(const RefinementOutcome& outcome, Map& map);

}  // namespace dhpmap

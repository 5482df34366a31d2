// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

/// Whether `from` can be made a part of `into`: two things that are there, on the same grid.
bool CanMerge(const Map& map, SubmapId from, SubmapId into);

/// Makes `from` a part of `into`, which keeps its id; `from` is removed, and MapInfo::merged says what became of it.
/// Requires CanMerge.
///   - A voxel of both is the weighted average, up to the most weight there is; where one was looked through until
///     nothing is left (GoneBlock) and the other was not, the other's. What is left of doubt is the lesser.
///   - Counts of labels are added. Whatever any submap's voxels have seen of `from` was `into`: no count is lost.
///   - Frames and classes are added up, times span both, the rest is that of the surer of them: it is there if one of
///     them is, active if one is, confirmed if one is, locked if one is. A class or name that somebody has set stays.
/// Safe at any time between frames: a refinement under way finds `from` gone (AdoptRefinement).
void MergeSubmaps(SubmapId from, SubmapId into, Map& map);

/// The same because somebody has said that they are one: noted for ever (PairVerdict::kMustBeOne), so that segments on
/// parts that stand apart go to the whole (Tracker), and confirmed.
void MergeForGood(SubmapId from, SubmapId into, Map& map);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

/// Whether `from` can be merged into `into`: two existing things on the same grid.
bool CanMerge(const Map& map, SubmapId from, SubmapId into);

/// Merges `from` into `into`, which keeps its id; `from` is removed and recorded in MapInfo::merged. Requires CanMerge.
///   - A voxel of both becomes the weighted average, with the weight capped. If one is contradicted (GoneBlock) and the
///     other is not, the other wins. The smaller gone count remains.
///   - Label counts are added. Counts of `from` in voxels of any submap become counts of `into`; none is lost.
///   - Frames and class totals are added, times span both, and other values are those of the surer one: the result is
///     present, active, confirmed or locked if one of them is. A class or name set by an edit stays.
///
/// Safe between any two frames: a running refinement finds `from` removed (AdoptRefinement).
void MergeSubmaps(SubmapId from, SubmapId into, Map& map);

/// The same by verdict of a user: recorded for ever (PairVerdict::kMustBeOne), so that segments on separate parts go to
/// the whole (Tracker), and confirmed.
void MergeForGood(SubmapId from, SubmapId into, Map& map);

}  // namespace dhpmap

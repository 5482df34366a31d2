// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// Cuts segments that lie apart in space into parts, each a segment of its own with the same row: what a network takes
/// for one object in the image may be two parked cars, or a car and the wall behind its outline. Bundles whose coarse
/// cells of `gap_vox` voxels touch, corners included, stay together; so parts are at least one, at most two cells
/// apart. `may_split` has a flag for each table row. The parts of a segment follow each other, the one with most points
/// first. Where all parts together would have more than kMaxBlocksAFrame cells, CutShortSegments instead, also for
/// segments that were cut short before.
void SplitIntoParts(const std::vector<bool>& may_split, int gap_vox, std::vector<SegmentBundles>& segments);

}  // namespace dhpmap

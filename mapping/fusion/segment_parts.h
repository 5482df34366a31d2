// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// Splits segments into spatially separate parts, each a segment with the same row: one segment of a network may cover
/// two parked cars, or a car and the wall behind its outline. Bundles whose coarse cells of `gap_vox` voxels touch,
/// corners included, stay together, so parts are one to two cells apart. `may_split` has a flag for each table row. The
/// parts of a segment are consecutive, the largest first. The result is CutShortSegments if the parts together exceed
/// kMaxBlocksAFrame cells, or if the input was cut short.
void SplitIntoParts(const std::vector<bool>& may_split, int gap_vox, std::vector<SegmentBundles>& segments);

}  // namespace dhpmap

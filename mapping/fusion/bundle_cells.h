// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/fusion/frame_tally.h"
#include "mapping/fusion/point_runs.h"
#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// Sums the runs of an empty segment into its bundles, the bundles of a cell together. Stops early if the frame has too
/// many cells. `cell_of` is scratch memory.
void BundleRuns(std::span<const PointRun* const> runs, FrameTally& tally, std::vector<std::uint32_t>& cell_of,
                SegmentBundles& segment);

}  // namespace dhpmap

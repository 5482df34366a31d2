// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "mapping/fusion/frame_tally.h"
#include "mapping/fusion/point_runs.h"
#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// Sums the runs of a segment, which is empty, up to its bundles, those of a cell together. Leaves it half built where
/// the frame has too many cells.
void BundleRuns(std::span<const PointRun* const> runs, FrameTally& tally, SegmentBundles& segment);

}  // namespace dhpmap

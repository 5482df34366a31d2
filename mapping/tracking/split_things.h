// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"
#include "mapping/tracking/assignment.h"
#include "mapping/tracking/overlap_table.h"

namespace dhpmap {

// Things that are two (ObjectPair::AreTwo), as somebody has split them or other frames show, and that a frame shows as
// one; likewise things that somebody has split from a background, in segments of its class. To frames with persistent
// ids only those are two of which somebody has said so.

/// See Tracker::CutAtSplits.
void CutSegmentsAtSplits(const PanopticFrame& frame, const Map& map, ThreadPool& pool,
                         std::vector<SegmentBundles>& segments);

/// A part of a segment that lies most on what is another thing than the one that it, or another part of the segment,
/// goes to goes there instead; so does a segment in one part if more than half of its points lie there. Not to what has
/// a grid of its own. Segments and overlaps are those of Tracker::Assign.
void HandToSplitParts(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                      const OverlapTable& overlaps, const Map& map, std::vector<Assignment>& assignments);

/// Whether somebody has split things from a background.
bool HasSplitBackground(const Map& map);

}  // namespace dhpmap

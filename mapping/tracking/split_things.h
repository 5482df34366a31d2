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

// Segments that show two things as one, although they are two (ObjectPair::AreTwo): an edit has split them, or other
// frames show them apart. The same for things that an edit has split from a background, in segments of that class. For
// frames with persistent ids only edits count.

/// See Tracker::CutAtSplits.
void CutSegmentsAtSplits(const PanopticFrame& frame, const Map& map, ThreadPool& pool,
                         std::vector<SegmentBundles>& segments);

/// Reassigns parts of segments. If most of a part lies on another of two such things than the one to which it, or
/// another part of its segment, is assigned, it is assigned to that thing; so is a segment in one part if more than
/// half of its points lie there. Never to a submap with its own grid. Segments and overlaps are those of
/// Tracker::Assign.
void HandToSplitParts(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                      const OverlapTable& overlaps, const Map& map, std::vector<Assignment>& assignments);

/// Whether an edit has split things from a background.
bool HasSplitBackground(const Map& map);

}  // namespace dhpmap

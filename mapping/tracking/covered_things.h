// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/thread_pool.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"
#include "mapping/tracking/overlap_table.h"

namespace dhpmap {

/// A segment that would begin a new thing of a class.
struct UnmatchedSegment {
  std::size_t segment;
  ClassId class_id;
};

struct CoveredMatch {
  std::size_t segment;
  SubmapId submap;
  double iou;
};

/// Matches things that lie flat on a larger thing of another class. Their points count for the larger thing, of which
/// more was observed there (see CountOverlaps), so each frame would create the flat thing anew. Therefore, if at least
/// half of an unmatched segment's points hit one thing of another class, all its points that lie on a thing of its own
/// class count for that thing. It matches if these are at least half of the points and their IoU is above
/// tracking.iou_threshold. Best first, one to one; ties go to the smaller id, then to the earlier segment. Never
/// matches things in `taken`, which other segments show, or absent things. Takes at most twice the time of
/// CountOverlaps. The result does not depend on the number of threads.
std::vector<CoveredMatch> MatchCovered(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                       const std::vector<UnmatchedSegment>& unmatched, const OverlapTable& overlaps,
                                       const std::vector<SubmapId>& taken, const Map& map, ThreadPool& pool);

}  // namespace dhpmap

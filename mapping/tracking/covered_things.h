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

/// A thing that lies flat on a larger one of another class has few points to itself: those of its segments count for
/// the larger one, of which more was observed there (see CountOverlaps), in each frame anew, and it would be made in
/// each anew. So where at least half of an unmatched segment's points hit one thing of another class, all its points
/// that lie on a thing of its own class count for that: if they are half of it at least, and their IoU is above the
/// threshold (tracking.iou_threshold), it matches. Best first, one to one; ties go to the smaller id, then to the
/// earlier segment. Not to things in `taken`, which others show already, nor to absent ones. At most what CountOverlaps
/// takes, twice; the same for any number of threads.
std::vector<CoveredMatch> MatchCovered(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                       const std::vector<UnmatchedSegment>& unmatched, const OverlapTable& overlaps,
                                       const std::vector<SubmapId>& taken, const Map& map, ThreadPool& pool);

}  // namespace dhpmap

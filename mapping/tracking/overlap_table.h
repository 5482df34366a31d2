// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// Overlap of a frame's segments with the map's things (paper II-B; algorithm.md 1): n_hits[segment][candidate] points.
struct OverlapTable {
  std::vector<SubmapId> candidates;             ///< ascending
  std::vector<std::vector<std::int64_t>> hits;  ///< one row a segment, one column a candidate
  std::vector<std::int64_t> candidate_hits;     ///< sum of each column
  /// hits / (points of the whole frame that hit the candidate + points of the segment - hits).
  [[nodiscard]] double Iou(std::size_t segment, std::size_t candidate, std::int64_t num_segment_points) const;
};

/// The hits of every segment on every thing that may be in view. A point counts for one thing at most: of those whose
/// surface is within the depth tolerance, the one that has been observed most there, the smaller id of equals. Else
/// whatever a few wrong segments have smeared over a neighbour would be seen with that neighbour for ever, and the
/// object whose it is would no longer match its own segments.
/// A voxel that was looked through (GoneBlock), or of a thing that is absent, is hit by segments of the thing's own
/// class only: it has come back.
OverlapTable CountOverlaps(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, const Map& map,
                           ThreadPool& pool);

}  // namespace dhpmap

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

/// The hits of every segment on every thing that may be in view. A point counts for at most one thing: among those with
/// a surface within the depth tolerance, the one with the most observations there (ties: the smaller id). Otherwise,
/// geometry that a few wrong segments smeared over a neighbour would match with that neighbour for ever, and the right
/// object would no longer match its own segments. Voxels with gone counts (GoneBlock), and voxels of absent things, are
/// hit only by segments of the thing's own class: it has come back.
OverlapTable CountOverlaps(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, const Map& map,
                           ThreadPool& pool);

}  // namespace dhpmap

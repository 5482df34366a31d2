// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/overlap_table.h"

#include <utility>

#include "mapping/tracking/things_in_view.h"

namespace dhpmap {

double OverlapTable::Iou(std::size_t segment, std::size_t candidate, std::int64_t num_segment_points) const {
  const std::int64_t shared = hits[segment][candidate];
  const std::int64_t all = candidate_hits[candidate] + num_segment_points - shared;
  return all > 0 ? static_cast<double>(shared) / static_cast<double>(all) : 0.0;
}

OverlapTable CountOverlaps(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, const Map& map,
                           ThreadPool& pool) {
  const ThingsInView things(frame, map);
  const std::size_t num_things = things.list().size();
  OverlapTable table;
  table.candidates.reserve(num_things);
  for (const ThingInView& thing : things.list()) table.candidates.push_back(thing.submap->id());
  table.hits.resize(segments.size());
  pool.ParallelFor(segments.size(), [&](std::size_t s) {
    const std::vector<std::uint32_t> hit_by = things.HitsOf(segments[s]);
    std::vector<std::int64_t> hits(num_things, 0);
    for (std::size_t b = 0; b < hit_by.size(); ++b) {
      if (hit_by[b] != ThingsInView::kNone) hits[hit_by[b]] += segments[s].bundles[b].num_points;
    }
    table.hits[s] = std::move(hits);
  });
  table.candidate_hits.assign(num_things, 0);
  for (const auto& row : table.hits) {
    for (std::size_t c = 0; c < row.size(); ++c) table.candidate_hits[c] += row[c];
  }
  return table;
}

}  // namespace dhpmap

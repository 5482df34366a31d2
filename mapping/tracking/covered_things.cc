// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/covered_things.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "mapping/tracking/things_in_view.h"

namespace dhpmap {

CoveredThings::CoveredThings(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, const Map& map,
                             std::vector<SubmapId> taken)
    : frame_(frame), segments_(segments), map_(map), taken_(std::move(taken)) {}

CoveredThings::Match CoveredThings::Find(const SegmentBundles& segment, ClassId class_id) {
  const ThingsInView things(frame_, map_);
  const double threshold = map_.info().config.tracking.iou_threshold;
  Match best;
  for (std::size_t t = 0; t < things.list().size(); ++t) {
    const Submap& thing = *things.list()[t].submap;
    const bool is_taken = std::find(taken_.begin(), taken_.end(), thing.id()) != taken_.end();
    if (is_taken || thing.IsAbsent() || !thing.info().IsSeenAs(class_id)) continue;
    const std::int64_t shared = things.NumPointsOn(segment, t);
    if (2 * shared < segment.num_points) continue;
    std::int64_t all = segment.num_points - shared;
    for (const SegmentBundles& other : segments_) all += things.NumPointsOn(other, t);
    const double iou = static_cast<double>(shared) / static_cast<double>(all);
    if (iou > threshold && iou > best.iou) best = {thing.id(), iou};
  }
  if (best.submap != kUnknownSubmap) taken_.push_back(best.submap);
  return best;
}

}  // namespace dhpmap

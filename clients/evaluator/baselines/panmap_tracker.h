// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "clients/evaluator/baselines/panmap_settings.h"
#include "clients/evaluator/baselines/panmap_submap.h"
#include "mapping/base/thread_pool.h"
#include "mapping/fusion/bundler.h"
#include "mapping/labels/label_set.h"
#include "mapping/map/map_config.h"

namespace dhpmap::evaluator {

/// Panmap's tracking of segments in the submaps that are active and in view. A point hits a submap where the voxel that
/// holds it has a distance within the tolerance; the IoU of a segment and a submap counts the frame's points (Panmap's
/// test by points, which its rendering approximates). A segment joins the submap of its own class, stuff and things
/// alike, of highest IoU, or makes a new one if it is large enough, else it is left out. Two segments may join one
/// submap.
class PanmapTracker {
 public:
  PanmapTracker(const MapConfig& config, const LabelSet& label_set, ThreadPool& pool)
      : config_(config), label_set_(label_set), pool_(pool) {}

  /// For each of `segments` (on the map's grid) the id of its submap, or 0 if it is left out. Makes submaps with ids
  /// from `next_id` on, and marks those that were tracked.
  std::vector<SubmapId> Assign(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                               const PanmapSettings& settings, PanmapSubmaps& submaps, SubmapId& next_id);

 private:
  using Counts = std::vector<std::int64_t>;
  [[nodiscard]] std::vector<Counts> CountHits(const std::vector<SegmentBundles>& segments,
                                              const std::vector<const PanmapSubmap*>& candidates,
                                              float tolerance_m) const;
  [[nodiscard]] std::int64_t MinPoints(const LabelClass& label_class) const;

  MapConfig config_;
  const LabelSet& label_set_;
  ThreadPool& pool_;
};

}  // namespace dhpmap::evaluator

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

/// Panmap's assignment of segments to active submaps in view. A point hits a submap if the distance stored in its voxel
/// is within the tolerance. The IoU of a segment and a submap counts points of the frame (Panmap's test by points,
/// which its rendering approximates). A segment joins the submap of its class, stuff or thing, with the highest IoU;
/// else it creates a new one if it is large enough, or is ignored. Two segments may join one submap.
class PanmapTracker {
 public:
  PanmapTracker(const MapConfig& config, const LabelSet& label_set, ThreadPool& pool)
      : config_(config), label_set_(label_set), pool_(pool) {}

  /// Returns for each of `segments` (on the map's grid) the id of its submap, or 0 if it is ignored. Creates submaps
  /// with ids from `next_id`, and marks the tracked ones.
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

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/panmap_tracker.h"

#include <algorithm>
#include <cmath>

#include "mapping/tracking/visibility.h"

namespace dhpmap::evaluator {
namespace {

std::int64_t HitsInCell(const SegmentBundles& segment, const BundleCell& cell, const Submap& submap,
                        float tolerance_m) {
  const BlockEntry* entry = submap.blocks().Find(cell.block);
  if (entry == nullptr || entry->tsdf == nullptr) return 0;
  std::int64_t hits = 0;
  for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
    const Bundle& bundle = segment.bundles[b];
    const bool is_hit =
        entry->tsdf->IsObserved(bundle.linear) && std::abs(entry->tsdf->distance_m[bundle.linear]) < tolerance_m;
    if (is_hit) hits += bundle.num_points;
  }
  return hits;
}

std::unique_ptr<PanmapSubmap> MakeSubmap(SubmapId id, const LabelClass& label_class, const MapConfig& config,
                                         const PanmapSettings& settings) {
  SubmapInfo info;
  info.id = id;
  info.panoptic = label_class.panoptic;
  info.class_id = label_class.id;
  info.voxel_size_m = config.voxel_size_m;
  info.truncation_m = config.truncation_m;
  return std::make_unique<PanmapSubmap>(std::move(info), settings.required_reobservations);
}

}  // namespace

std::vector<PanmapTracker::Counts> PanmapTracker::CountHits(const std::vector<SegmentBundles>& segments,
                                                            const std::vector<const PanmapSubmap*>& candidates,
                                                            float tolerance_m) const {
  std::vector<Counts> hits(segments.size(), Counts(candidates.size(), 0));
  pool_.ParallelFor(segments.size(), [&](std::size_t s) {
    for (const BundleCell& cell : segments[s].cells) {
      for (std::size_t c = 0; c < candidates.size(); ++c) {
        hits[s][c] += HitsInCell(segments[s], cell, candidates[c]->geometry, tolerance_m);
      }
    }
  });
  return hits;
}

std::int64_t PanmapTracker::MinPoints(const LabelClass& label_class) const {
  const TrackingConfig& tracking = config_.tracking;
  if (label_class.panoptic == Panoptic::kStuff) return tracking.min_points_stuff;
  switch (label_class.size) {
    case SizeClass::kSmall: return tracking.min_points_small;
    case SizeClass::kMedium: return tracking.min_points_medium;
    case SizeClass::kLarge: return tracking.min_points_large;
  }
  return tracking.min_points_medium;
}

std::vector<SubmapId> PanmapTracker::Assign(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                            const PanmapSettings& settings, PanmapSubmaps& submaps, SubmapId& next_id) {
  std::vector<const PanmapSubmap*> candidates;
  for (const auto& submap : submaps) {
    submap->was_tracked = false;
    const bool is_candidate =
        submap->IsActive() && MayBeInView(frame, config_.integration.max_range_m, submap->geometry.bounding_sphere());
    if (is_candidate) candidates.push_back(submap.get());
  }
  const auto tolerance_m = static_cast<float>(settings.depth_tolerance_vox * config_.voxel_size_m);
  const std::vector<Counts> hits = CountHits(segments, candidates, tolerance_m);
  Counts all_hits(candidates.size(), 0);
  for (const Counts& row : hits) {
    for (std::size_t c = 0; c < row.size(); ++c) all_hits[c] += row[c];
  }

  std::vector<SubmapId> assigned(segments.size(), kUnknownSubmap);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (segments[s].row < 0) continue;
    const std::optional<ClassId> class_id = frame.segments[static_cast<std::size_t>(segments[s].row)].class_id;
    if (!class_id) continue;
    double best_iou = 0;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (candidates[c]->geometry.info().class_id != *class_id) continue;
      const std::int64_t all = all_hits[c] + segments[s].num_points - hits[s][c];
      const double iou = static_cast<double>(hits[s][c]) / static_cast<double>(all);
      if (iou < settings.iou_threshold || iou <= best_iou) continue;  // on ties the smaller id
      best_iou = iou;
      assigned[s] = candidates[c]->geometry.id();
    }
    const LabelClass& label_class = *label_set_.Find(*class_id);
    if (assigned[s] == kUnknownSubmap && segments[s].num_points >= MinPoints(label_class)) {
      assigned[s] = next_id++;
      submaps.push_back(MakeSubmap(assigned[s], label_class, config_, settings));
    }
  }
  for (const auto& submap : submaps) {
    if (std::find(assigned.begin(), assigned.end(), submap->geometry.id()) != assigned.end()) {
      submap->was_tracked = true;
    }
  }
  return assigned;
}

}  // namespace dhpmap::evaluator

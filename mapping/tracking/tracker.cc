// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "mapping/map/map_grid.h"
#include "mapping/tracking/visibility.h"

namespace dhpmap {
namespace {

/// A thing that a segment may match, on the map's grid or moved away from it.
struct Candidate {
  const Submap* submap;
  ClassId class_id;
  BoundingSphere sphere_map;
  bool is_on_map_grid;
  float tolerance_m;
};

/// Where an object was and is no longer, something of its class may be it come back; anything else is not.
bool MayReturn(const Candidate& candidate, std::optional<ClassId> class_id) { return class_id == candidate.class_id; }

bool IsHit(const BlockEntry& entry, int linear, bool may_return, float tolerance_m) {
  return (may_return ? entry.tsdf->IsObserved(linear) : entry.Shows(linear)) &&
         std::abs(entry.tsdf->distance_m[static_cast<std::size_t>(linear)]) < tolerance_m;
}

/// Points of the cell that hit a candidate on the same grid: exact, since all points of a bundle share its voxel.
std::int64_t CountAlignedHits(const SegmentBundles& segment, const BundleCell& cell, const Candidate& candidate,
                              bool may_return) {
  const BlockEntry* entry = candidate.submap->blocks().Find(cell.block);
  if (entry == nullptr || entry->tsdf == nullptr) return 0;
  std::int64_t hits = 0;
  for (std::uint32_t b = 0; b < cell.num_bundles; ++b) {
    const Bundle& bundle = segment.bundles[cell.first_bundle + b];
    if (IsHit(*entry, bundle.linear, may_return, candidate.tolerance_m)) hits += bundle.num_points;
  }
  return hits;
}

/// The same for a candidate with a pose or voxel size of its own: each bundle stands at its mean point.
std::int64_t CountMovedHits(const SegmentBundles& segment, const BundleCell& cell, const Candidate& candidate,
                            bool may_return, const Eigen::Vector3d& sensor_map) {
  const Transform T_submap_map = candidate.submap->info().T_map_submap.inverse();
  std::int64_t hits = 0;
  for (std::uint32_t b = 0; b < cell.num_bundles; ++b) {
    const Bundle& bundle = segment.bundles[cell.first_bundle + b];
    const Eigen::Vector3d p_map = sensor_map + (bundle.weighted_sum_m / bundle.weight).cast<double>();
    const VoxelIndex voxel = VoxelAt(T_submap_map * p_map, candidate.submap->info().voxel_size_m);
    const BlockEntry* entry = candidate.submap->blocks().Find(BlockOf(voxel));
    if (entry == nullptr || entry->tsdf == nullptr) continue;
    if (IsHit(*entry, LinearIndex(voxel), may_return, candidate.tolerance_m)) hits += bundle.num_points;
  }
  return hits;
}

const Submap* FindStuff(const Map& map, ClassId class_id) {
  for (const auto& submap : map.submaps()) {
    if (submap->info().panoptic == Panoptic::kStuff && submap->info().class_id == class_id) return submap.get();
  }
  return nullptr;
}

const Submap* FindTrack(const Map& map, std::uint32_t track_id) {
  for (const auto& submap : map.submaps()) {
    if (submap->info().track_id == track_id) return submap.get();
  }
  return nullptr;
}

}  // namespace

double OverlapTable::Iou(std::size_t segment, std::size_t candidate, std::int64_t num_segment_points) const {
  const std::int64_t shared = hits[segment][candidate];
  const std::int64_t all = candidate_hits[candidate] + num_segment_points - shared;
  return all > 0 ? static_cast<double>(shared) / static_cast<double>(all) : 0.0;
}

bool Touch(const SegmentBundles& a, const SegmentBundles& b) {
  for (const BundleCell& cell : a.cells) {
    for (std::uint32_t i = 0; i < cell.num_bundles; ++i) {
      const VoxelIndex v = VoxelIn(cell.block, a.bundles[cell.first_bundle + i].linear);
      for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            if (b.EndsIn({v.x + dx, v.y + dy, v.z + dz})) return true;
    }
  }
  return false;
}

OverlapTable Tracker::CountOverlaps(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                    const Map& map) {
  std::vector<Candidate> candidates;
  OverlapTable table;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    const BoundingSphere sphere = submap->BoundingSphereInMap();
    if (info.panoptic != Panoptic::kThing || !MayBeInView(frame, config_.integration.max_range_m, sphere)) continue;
    const bool on_grid = IsOnMapGrid(info, config_);
    candidates.push_back({submap.get(), info.class_id, sphere, on_grid,
                          static_cast<float>(config_.tracking.depth_tolerance_vox * info.voxel_size_m)});
    table.candidates.push_back(info.id);
  }

  const Eigen::Vector3d sensor_map = frame.T_map_sensor.translation();
  const double cell_side_m = kBlockSide * config_.voxel_size_m;
  const double cell_radius_m = std::sqrt(3.0) / 2 * cell_side_m;
  table.hits.assign(segments.size(), std::vector<std::int64_t>(candidates.size(), 0));
  pool_.ParallelFor(segments.size(), [&](std::size_t s) {
    std::optional<ClassId> class_id;
    if (segments[s].row >= 0) class_id = frame.segments[static_cast<std::size_t>(segments[s].row)].class_id;
    for (const BundleCell& cell : segments[s].cells) {
      const Eigen::Vector3d center =
          BlockCorner(cell.block, config_.voxel_size_m) + Eigen::Vector3d::Constant(cell_side_m / 2);
      for (std::size_t c = 0; c < candidates.size(); ++c) {
        const Candidate& candidate = candidates[c];
        if (!candidate.sphere_map.Intersects({center, cell_radius_m})) continue;
        const bool may_return = MayReturn(candidate, class_id);
        if (candidate.submap->IsAbsent() && !may_return) continue;
        table.hits[s][c] += candidate.is_on_map_grid
                                ? CountAlignedHits(segments[s], cell, candidate, may_return)
                                : CountMovedHits(segments[s], cell, candidate, may_return, sensor_map);
      }
    }
  });
  table.candidate_hits.assign(candidates.size(), 0);
  for (const auto& row : table.hits) {
    for (std::size_t c = 0; c < row.size(); ++c) table.candidate_hits[c] += row[c];
  }
  return table;
}

void Tracker::MatchThings(const std::vector<SegmentBundles>& segments, const std::vector<bool>& is_open,
                          const PanopticFrame& frame, const OverlapTable& overlaps, const Map& map,
                          std::vector<Assignment>& assignments) const {
  struct Pair {
    double iou;
    std::size_t candidate, segment;
  };
  std::vector<Pair> pairs;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!is_open[s]) continue;
    const ClassId class_id = *frame.segments[static_cast<std::size_t>(segments[s].row)].class_id;
    for (std::size_t c = 0; c < overlaps.candidates.size(); ++c) {
      if (config_.tracking.match_requires_class && map.Find(overlaps.candidates[c])->info().class_id != class_id)
        continue;
      const double iou = overlaps.Iou(s, c, segments[s].num_points);
      if (iou > config_.tracking.iou_threshold) pairs.push_back({iou, c, s});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    if (a.iou != b.iou) return a.iou > b.iou;
    return a.candidate != b.candidate ? a.candidate < b.candidate : a.segment < b.segment;
  });

  std::vector<std::vector<std::size_t>> joined(overlaps.candidates.size());
  std::vector<bool> is_matched(segments.size(), false);
  for (const Pair& pair : pairs) {
    if (is_matched[pair.segment]) continue;
    auto& others = joined[pair.candidate];
    const bool may_join = others.empty() || std::any_of(others.begin(), others.end(), [&](std::size_t other) {
                            return Touch(segments[pair.segment], segments[other]);
                          });
    if (!may_join) continue;
    others.push_back(pair.segment);
    is_matched[pair.segment] = true;
    assignments[pair.segment] = {overlaps.candidates[pair.candidate], false, static_cast<float>(pair.iou)};
  }

  // A part that lies on the object that another part of its segment joined belongs to that object.
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!is_open[s] || is_matched[s]) continue;
    for (std::size_t c = 0; c < overlaps.candidates.size(); ++c) {
      const bool is_sibling = std::any_of(joined[c].begin(), joined[c].end(),
                                          [&](std::size_t other) { return segments[other].row == segments[s].row; });
      if (!is_sibling || 2 * overlaps.hits[s][c] <= segments[s].num_points) continue;
      assignments[s] = {overlaps.candidates[c], false, static_cast<float>(overlaps.Iou(s, c, segments[s].num_points))};
      break;
    }
  }
}

std::int64_t Tracker::MinPoints(const LabelClass& label_class) const {
  if (label_class.panoptic == Panoptic::kStuff) return config_.tracking.min_points_stuff;
  switch (label_class.size) {
    case SizeClass::kSmall: return config_.tracking.min_points_small;
    case SizeClass::kMedium: return config_.tracking.min_points_medium;
    case SizeClass::kLarge: return config_.tracking.min_points_large;
  }
  return config_.tracking.min_points_medium;
}

SubmapId Tracker::CreateSubmap(const PanopticFrame& frame, const SegmentInfo& segment, const LabelClass& label_class,
                               Map& map) const {
  const bool is_thing = label_class.panoptic == Panoptic::kThing;
  SubmapInfo info;
  info.panoptic = label_class.panoptic;
  info.class_id = label_class.id;
  info.voxel_size_m = config_.voxel_size_m;
  info.truncation_m = config_.truncation_m;
  info.is_confirmed = !is_thing || frame.has_persistent_ids || config_.activity.required_reobservations == 0;
  info.first_observed_ns = info.last_observed_ns = frame.stamp_ns;
  if (is_thing && frame.has_persistent_ids) info.track_id = segment.id.value;
  return map.Create(std::move(info)).id();
}

std::vector<Assignment> Tracker::Assign(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                        Map& map) {
  const LabelSet& label_set = *map.info().label_set;
  std::vector<Assignment> assignments(segments.size());
  std::vector<bool> is_open(segments.size(), false);  // to be matched by overlap
  std::vector<const LabelClass*> classes(segments.size(), nullptr);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (segments[s].row < 0) continue;
    const SegmentInfo& segment = frame.segments[static_cast<std::size_t>(segments[s].row)];
    if (!segment.class_id || segment.IsDoubtful(config_.tracking.min_score)) continue;
    classes[s] = label_set.Find(*segment.class_id);
    if (classes[s]->panoptic == Panoptic::kStuff) {
      if (const Submap* stuff = FindStuff(map, classes[s]->id)) assignments[s].submap = stuff->id();
    } else if (frame.has_persistent_ids) {
      if (const Submap* known = FindTrack(map, segment.id.value)) assignments[s].submap = known->id();
    } else {
      is_open[s] = true;
    }
  }
  if (std::find(is_open.begin(), is_open.end(), true) != is_open.end()) {
    MatchThings(segments, is_open, frame, CountOverlaps(frame, segments, map), map, assignments);
  }
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (classes[s] == nullptr || assignments[s].submap != kUnknownSubmap) continue;
    if (segments[s].num_points < MinPoints(*classes[s])) continue;
    const SegmentInfo& segment = frame.segments[static_cast<std::size_t>(segments[s].row)];
    // Two segments of one background class in one frame share the submap that the first of them made.
    if (classes[s]->panoptic == Panoptic::kStuff) {
      if (const Submap* stuff = FindStuff(map, classes[s]->id)) {
        assignments[s] = {stuff->id(), false, 0};
        continue;
      }
    }
    assignments[s] = {CreateSubmap(frame, segment, *classes[s], map), true, 0};
  }
  return assignments;
}

}  // namespace dhpmap

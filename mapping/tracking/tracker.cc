// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/tracker.h"

#include <algorithm>
#include <optional>

namespace dhpmap {
namespace {

/// Of the largest part of its segment: a smaller one makes no object.
constexpr double kLeastShareOfPart = 0.1;

const Submap* FindStuff(const Map& map, ClassId class_id) {
  for (const auto& submap : map.submaps()) {
    if (submap->info().panoptic == Panoptic::kStuff && submap->info().class_id == class_id) return submap.get();
  }
  return nullptr;
}

/// What `track_id` means in a session. Where nobody has noted whose track a thing is, it is any session's.
const Submap* FindTrack(const Map& map, const std::string& session, std::uint32_t track_id) {
  const Submap* of_any = nullptr;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    if (info.sightings.TrackOf(session) == track_id) return submap.get();
    if (of_any == nullptr && info.track_id == track_id && !info.sightings.HasTrack()) of_any = submap.get();
  }
  return of_any;
}

/// Only other sessions know it by an id.
bool IsTrackOfOthers(const SubmapInfo& info, const std::string& session) {
  return info.panoptic == Panoptic::kThing && info.sightings.HasTrack() && info.sightings.TrackOf(session) == 0;
}

void SetTrack(const PanopticFrame& frame, const SegmentInfo& segment, SubmapId id, Map& map) {
  map.FindMutable(id)->mutable_info().sightings.SetTrack(frame.session, segment.id.value);
}

bool HasTracksOfOthers(const Map& map, const std::string& session) {
  return std::any_of(map.submaps().begin(), map.submaps().end(),
                     [&](const auto& submap) { return IsTrackOfOthers(submap->info(), session); });
}

/// What bleeds over the border of a mask onto what is behind it is a part of few points, or lies on a thing that is
/// there already: it is no object of its own. If it is one after all, other frames will tell. Parts of a segment follow
/// each other, the largest first.
bool IsMaskBorder(const std::vector<SegmentBundles>& segments, std::size_t s, const OverlapTable& overlaps) {
  std::size_t first = s;
  while (first > 0 && segments[first - 1].row == segments[s].row) --first;
  if (first == s) return false;
  const auto num_points = static_cast<double>(segments[s].num_points);
  if (num_points < kLeastShareOfPart * static_cast<double>(segments[first].num_points)) return true;
  const std::vector<std::int64_t>& hits = overlaps.hits[s];
  return std::any_of(hits.begin(), hits.end(), [&](std::int64_t n) { return 2 * n >= segments[s].num_points; });
}

}  // namespace

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
      const SubmapInfo& candidate = map.Find(overlaps.candidates[c])->info();
      if (config_.tracking.match_requires_class && candidate.class_id != class_id) continue;
      if (frame.has_persistent_ids && !IsTrackOfOthers(candidate, frame.session)) continue;
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
    const bool may_join = others.empty() || (!frame.has_persistent_ids &&
                                             std::any_of(others.begin(), others.end(), [&](std::size_t other) {
                                               return Touch(segments[pair.segment], segments[other]);
                                             }));
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
  if (is_thing && frame.has_persistent_ids) {
    info.track_id = segment.id.value;
    info.sightings.SetTrack(frame.session, segment.id.value);
  }
  return map.Create(std::move(info)).id();
}

void Tracker::NoteTracks(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                         const std::vector<bool>& is_open, const std::vector<Assignment>& assignments, Map& map) {
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!is_open[s] || assignments[s].submap == kUnknownSubmap) continue;
    const SegmentInfo& segment = frame.segments[static_cast<std::size_t>(segments[s].row)];
    SetTrack(frame, segment, assignments[s].submap, map);
  }
}

std::vector<Assignment> Tracker::Assign(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                        Map& map) {
  const LabelSet& label_set = *map.info().label_set;
  std::vector<Assignment> assignments(segments.size());
  std::vector<bool> is_open(segments.size(), false);  // to be matched by overlap
  const bool has_others = frame.has_persistent_ids && HasTracksOfOthers(map, frame.session);
  std::vector<const LabelClass*> classes(segments.size(), nullptr);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (segments[s].row < 0) continue;
    const SegmentInfo& segment = frame.segments[static_cast<std::size_t>(segments[s].row)];
    if (!segment.class_id || segment.IsDoubtful(config_.tracking.min_score)) continue;
    classes[s] = label_set.Find(*segment.class_id);
    if (classes[s]->panoptic == Panoptic::kStuff) {
      if (const Submap* stuff = FindStuff(map, classes[s]->id)) assignments[s].submap = stuff->id();
    } else if (frame.has_persistent_ids) {
      if (const Submap* known = FindTrack(map, frame.session, segment.id.value)) {
        assignments[s].submap = known->id();
        if (!known->info().sightings.HasTrack()) SetTrack(frame, segment, known->id(), map);
      } else {
        is_open[s] = has_others;
      }
    } else {
      is_open[s] = true;
    }
  }
  overlaps_ = {};
  if (std::find(is_open.begin(), is_open.end(), true) != is_open.end()) {
    overlaps_ = CountOverlaps(frame, segments, map, pool_);
    MatchThings(segments, is_open, frame, overlaps_, map, assignments);
    if (frame.has_persistent_ids) NoteTracks(frame, segments, is_open, assignments, map);
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
    if (is_open[s] && IsMaskBorder(segments, s, overlaps_)) continue;
    assignments[s] = {CreateSubmap(frame, segment, *classes[s], map), true, 0};
  }
  return assignments;
}

}  // namespace dhpmap

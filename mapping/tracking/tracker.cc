// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/tracker.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "mapping/tracking/covered_things.h"
#include "mapping/tracking/find_stuff.h"
#include "mapping/tracking/find_track.h"
#include "mapping/tracking/split_things.h"
#include "mapping/tracking/visibility.h"

namespace dhpmap {
namespace {

/// Minimum share of the largest part of its segment: a smaller part creates no object.
constexpr double kLeastShareOfPart = 0.1;

/// Whether only other sessions have an id for it.
bool IsTrackOfOthers(const SubmapInfo& info, const std::string& session) {
  return info.panoptic == Panoptic::kThing && info.sightings.HasTrack() && info.sightings.TrackOf(session) == 0;
}

/// Locked things do not change.
void NoteTrack(const PanopticFrame& frame, const SegmentInfo& segment, SubmapId id, Map& map) {
  if (map.Find(id)->info().is_locked) return;
  map.FindMutable(id)->mutable_info().sightings.AddTrack(frame.session, segment.id.value);
}

bool IsLockedThing(const SubmapInfo& info) { return info.panoptic == Panoptic::kThing && info.is_locked; }

bool HasLockedThing(const Map& map) {
  return std::any_of(map.submaps().begin(), map.submaps().end(),
                     [](const auto& submap) { return IsLockedThing(submap->info()); });
}

/// The locked thing that at least half of the segment's points hit, regardless of the frame's class.
std::optional<SubmapId> LockedBelow(std::size_t s, std::int64_t num_points, const OverlapTable& overlaps,
                                    const Map& map) {
  for (std::size_t c = 0; c < overlaps.candidates.size(); ++c) {
    const SubmapId id = overlaps.candidates[c];
    if (map.Find(id)->info().is_locked && 2 * overlaps.hits[s][c] >= num_points) return id;
  }
  return std::nullopt;
}

/// Things that users have merged from several.
std::vector<SubmapId> MergedBySomebody(const MapInfo& map) {
  std::vector<SubmapId> merged;
  for (const ObjectPair& pair : map.pairs.pairs()) {
    if (pair.verdict != PairVerdict::kMustBeOne) continue;
    if (map.merged.Into(pair.second) == pair.first) merged.push_back(pair.first);
    if (map.merged.Into(pair.first) == pair.second) merged.push_back(pair.second);
  }
  return merged;
}

/// Things that users have split, or kept apart.
std::vector<SubmapId> SplitBySomebody(const MapInfo& map) {
  std::vector<SubmapId> split;
  for (const ObjectPair& pair : map.pairs.pairs()) {
    if (pair.verdict == PairVerdict::kMustBeTwo) split.insert(split.end(), {pair.first, pair.second});
  }
  return split;
}

bool Has(const std::vector<SubmapId>& ids, SubmapId id) { return std::find(ids.begin(), ids.end(), id) != ids.end(); }

/// Whether the frame may show one of them. Some may no longer exist.
bool AnyMayBeInView(const std::vector<SubmapId>& ids, const PanopticFrame& frame, const Map& map) {
  const double max_range_m = map.info().config.integration.max_range_m;
  return std::any_of(ids.begin(), ids.end(), [&](SubmapId id) {
    const Submap* submap = map.Find(id);
    return submap != nullptr && MayBeInView(frame, max_range_m, submap->BoundingSphereInMap());
  });
}

/// Finds segments that lie on edited things without a match.
class EditedBelow {
 public:
  EditedBelow(const PanopticFrame& frame, const Map& map) : merged_(MergedBySomebody(map.info())), map_(map) {
    if (frame.has_persistent_ids) split_ = SplitBySomebody(map.info());
  }

  [[nodiscard]] bool IsMerged(SubmapId id) const { return Has(merged_, id); }
  /// Whether a segment of this class, most of whose points hit the thing, belongs to the thing.
  [[nodiscard]] bool MayTake(SubmapId id, ClassId class_id, bool is_taken) const {
    const SubmapInfo& info = map_.Find(id)->info();
    if (!info.IsSeenAs(class_id)) return false;
    return IsMerged(id) || (!is_taken && IsUnknownPart(info));
  }

 private:
  /// It was split off, and no session has an id for it yet.
  [[nodiscard]] bool IsUnknownPart(const SubmapInfo& info) const {
    return info.track_id == 0 && !info.sightings.HasTrack() && Has(split_, info.id);
  }

  std::vector<SubmapId> merged_, split_;
  const Map& map_;
};

bool HasTracksOfOthers(const Map& map, const std::string& session) {
  return std::any_of(map.submaps().begin(), map.submaps().end(),
                     [&](const auto& submap) { return IsTrackOfOthers(submap->info(), session); });
}

/// A mask that bleeds over its border onto the background gives a small part, or a part on an existing thing: it is not
/// an object. If it is one after all, other frames will show it. Parts of a segment follow each other, the largest
/// first.
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
      if (config_.tracking.match_requires_class && !candidate.IsSeenAs(class_id)) continue;
      if (frame.has_persistent_ids && !IsTrackOfOthers(candidate, frame.session) && !candidate.is_locked) continue;
      const double iou = overlaps.Iou(s, c, segments[s].num_points);
      if (iou > config_.tracking.iou_threshold) pairs.push_back({iou, c, s});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    if (a.iou != b.iou) return a.iou > b.iou;
    return a.candidate != b.candidate ? a.candidate < b.candidate : a.segment < b.segment;
  });

  const EditedBelow edited(frame, map);
  std::vector<std::vector<std::size_t>> joined(overlaps.candidates.size());
  std::vector<bool> is_matched(segments.size(), false);
  for (const Pair& pair : pairs) {
    if (is_matched[pair.segment]) continue;
    auto& others = joined[pair.candidate];
    const bool may_join =
        others.empty() || edited.IsMerged(overlaps.candidates[pair.candidate]) ||
        (!frame.has_persistent_ids && std::any_of(others.begin(), others.end(), [&](std::size_t other) {
          return Touch(segments[pair.segment], segments[other]);
        }));
    if (!may_join) continue;
    others.push_back(pair.segment);
    is_matched[pair.segment] = true;
    assignments[pair.segment] = {overlaps.candidates[pair.candidate], false, static_cast<float>(pair.iou)};
  }

  // A part on the object that another part of its segment joined belongs to that object. So does a part on a thing that
  // a user has merged or split off.
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (!is_open[s] || is_matched[s]) continue;
    const ClassId class_id = *frame.segments[static_cast<std::size_t>(segments[s].row)].class_id;
    for (std::size_t c = 0; c < overlaps.candidates.size(); ++c) {
      const bool is_sibling = std::any_of(joined[c].begin(), joined[c].end(),
                                          [&](std::size_t other) { return segments[other].row == segments[s].row; });
      if (2 * overlaps.hits[s][c] <= segments[s].num_points) continue;
      if (!is_sibling && !edited.MayTake(overlaps.candidates[c], class_id, !joined[c].empty())) continue;
      joined[c].push_back(s);
      assignments[s] = {overlaps.candidates[c], false, static_cast<float>(overlaps.Iou(s, c, segments[s].num_points))};
      break;
    }
  }
}

void Tracker::MatchLocked(const std::vector<SegmentBundles>& segments, const std::vector<const LabelClass*>& classes,
                          const Map& map, std::vector<Assignment>& assignments) const {
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const bool is_stuff = classes[s] != nullptr && classes[s]->panoptic == Panoptic::kStuff;
    if (segments[s].row < 0 || is_stuff || assignments[s].submap != kUnknownSubmap) continue;
    if (const auto locked = LockedBelow(s, segments[s].num_points, overlaps_, map)) assignments[s].submap = *locked;
  }
}

void Tracker::AssignCovered(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                            const std::vector<const LabelClass*>& classes, const std::vector<bool>& is_open,
                            const Map& map, std::vector<Assignment>& assignments) const {
  std::vector<UnmatchedSegment> unmatched;
  std::vector<SubmapId> taken;
  taken.reserve(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    taken.push_back(assignments[s].submap);
    if (!is_open[s] || assignments[s].submap != kUnknownSubmap) continue;
    if (segments[s].num_points < MinPoints(*classes[s]) || IsMaskBorder(segments, s, overlaps_)) continue;
    unmatched.push_back({s, classes[s]->id});
  }
  for (const CoveredMatch& match : MatchCovered(frame, segments, unmatched, overlaps_, taken, map, pool_)) {
    assignments[match.segment] = {match.submap, false, static_cast<float>(match.iou)};
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
    NoteTrack(frame, segment, assignments[s].submap, map);
  }
}

void Tracker::CutAtSplits(const PanopticFrame& frame, const Map& map, std::vector<SegmentBundles>& segments) const {
  CutSegmentsAtSplits(frame, map, pool_, segments);
}

std::vector<Assignment> Tracker::Assign(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                        Map& map) {
  const LabelSet& label_set = *map.info().label_set;
  std::vector<Assignment> assignments(segments.size());
  std::vector<bool> is_open(segments.size(), false);  // to be matched by overlap
  const bool has_others = frame.has_persistent_ids && HasTracksOfOthers(map, frame.session);
  const bool has_locked = HasLockedThing(map);
  const bool has_merged = frame.has_persistent_ids && AnyMayBeInView(MergedBySomebody(map.info()), frame, map);
  const bool has_split = frame.has_persistent_ids && AnyMayBeInView(SplitBySomebody(map.info()), frame, map);
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
        if (!known->info().sightings.HasTrack()) NoteTrack(frame, segment, known->id(), map);
      } else {
        is_open[s] = has_others || has_locked || has_merged || has_split;
      }
    } else {
      is_open[s] = true;
    }
  }
  overlaps_ = {};
  if (has_locked || has_split || HasSplitBackground(map) ||
      std::find(is_open.begin(), is_open.end(), true) != is_open.end()) {
    overlaps_ = CountOverlaps(frame, segments, map, pool_);
    MatchThings(segments, is_open, frame, overlaps_, map, assignments);
    if (has_locked) MatchLocked(segments, classes, map, assignments);
    if (frame.has_persistent_ids) NoteTracks(frame, segments, is_open, assignments, map);
    HandToSplitParts(frame, segments, overlaps_, map, assignments);
  }
  if (!frame.has_persistent_ids) AssignCovered(frame, segments, classes, is_open, map, assignments);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (classes[s] == nullptr || assignments[s].submap != kUnknownSubmap) continue;
    if (segments[s].num_points < MinPoints(*classes[s])) continue;
    const SegmentInfo& segment = frame.segments[static_cast<std::size_t>(segments[s].row)];
    // Two segments of one background class in a frame share the submap created by the first.
    if (classes[s]->panoptic == Panoptic::kStuff) {
      if (const Submap* stuff = FindStuff(map, classes[s]->id)) {
        assignments[s] = {stuff->id(), false, 0};
        continue;
      }
    }
    if (is_open[s] && IsMaskBorder(segments, s, overlaps_)) continue;
    assignments[s] = {CreateSubmap(frame, segment, *classes[s], map), true, 0};
  }
  if (frame.has_persistent_ids && !has_others && !has_locked) overlaps_ = {};  // persistent ids tell pairs apart
  return assignments;
}

}  // namespace dhpmap

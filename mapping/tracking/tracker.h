// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"
#include "mapping/tracking/assignment.h"
#include "mapping/tracking/overlap_table.h"

namespace dhpmap {

/// Spatial submap id tracker (paper II-B): finds the submap of every segment of a frame, or makes one.
///   - persistent ids: the thing with that track id of the frame's session; if there is none, of the things that only
///     other sessions have track ids of, the one that overlaps best is also the session's from then on;
///   - background: the one submap of its class, also when somebody has given it another since;
///   - things: matched with thing submaps by IoU, best first, one to one; a second segment may join a submap only if it
///     touches one that did (a split segment);
///     what counts as overlap: CountOverlaps;
///   - what somebody has merged (PairVerdict::kMustBeOne) any number of segments may join, whether they touch or not;
///     one of its class that has matched nothing does if most of its points lie on it, whatever its id;
///   - what is two: CutAtSplits; a segment that would go to one of the two goes to the other if most of its points lie
///     on that; so does one whose persistent id nobody knows, of the thing's class, if the thing
///     has no id yet, which it then has;
///   - locked: a segment whose id the frame's session knows nothing by may match a locked thing by overlap, too, and
///   one
///     that is no background and matches nothing is a match of the locked thing that half of its points lie on;
///   - what the network itself doubts (tracking.min_score) goes to the unknown submap;
///   - a thing's segment that would make a new submap goes to one of its class that it lies on, though others hide it
///     (MatchCovered);
///   - what is left makes a new submap if it is large enough and no mere border of a mask, else goes to the unknown
///     submap.
/// Ties are broken by submap id, then by table row. Thread-compatible.
class Tracker {
 public:
  Tracker(const MapConfig& config, ThreadPool& pool) : config_(config), pool_(pool) {}

  /// Before Assign: where one segment shows two things that are two (ObjectPair::AreTwo; to frames with persistent ids
  /// only where somebody has said so), as no other segment shows the second, what lies on that one becomes a segment of
  /// its own with the same row, which goes to it. A few points show nothing, and what goes to a thing with a grid of
  /// its own stays whole. Parts of a segment follow each other, the largest first.
  void CutAtSplits(const PanopticFrame& frame, const Map& map, std::vector<SegmentBundles>& segments) const;

  /// One assignment a segment of `segments` (see Bundler), on the map's grid. Creates submaps in `map`.
  std::vector<Assignment> Assign(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, Map& map);

  /// What the last Assign has matched by; empty if there was nothing to match.
  [[nodiscard]] const OverlapTable& overlaps() const { return overlaps_; }

 private:
  void MatchThings(const std::vector<SegmentBundles>& segments, const std::vector<bool>& is_open,
                   const PanopticFrame& frame, const OverlapTable& overlaps, const Map& map,
                   std::vector<Assignment>& assignments) const;
  void MatchLocked(const std::vector<SegmentBundles>& segments, const std::vector<const LabelClass*>& classes,
                   const Map& map, std::vector<Assignment>& assignments) const;
  /// What a frame with persistent ids was matched with by overlap has its id from now on.
  static void NoteTracks(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                         const std::vector<bool>& is_open, const std::vector<Assignment>& assignments, Map& map);
  void AssignCovered(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                     const std::vector<const LabelClass*>& classes, const std::vector<bool>& is_open, const Map& map,
                     std::vector<Assignment>& assignments) const;
  [[nodiscard]] std::int64_t MinPoints(const LabelClass& label_class) const;
  SubmapId CreateSubmap(const PanopticFrame& frame, const SegmentInfo& segment, const LabelClass& label_class,
                        Map& map) const;

  MapConfig config_;
  ThreadPool& pool_;
  OverlapTable overlaps_;
};

/// True if a bundle of `a` ends in or beside (26 neighbours) a voxel in which one of `b` ends.
bool Touch(const SegmentBundles& a, const SegmentBundles& b);

}  // namespace dhpmap

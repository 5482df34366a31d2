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

/// Spatial submap id tracker (paper II-B): finds the submap of every segment of a frame, or creates one.
///   - Persistent ids: the thing with that track id in the frame's session. Without one, the best overlap among things
///     that have track ids only of other sessions; that thing then gets this id.
///   - Background: the one submap of its class, even if an edit has given that submap another class.
///   - Things: matched with thing submaps by IoU (CountOverlaps), best first, one to one. A second segment may join a
///     submap only if it touches one that did (a split segment).
///   - Things merged by an edit (PairVerdict::kMustBeOne): any number of segments may join, touching or not. An
///     unmatched segment of its class joins if most of its points lie on it, whatever its id.
///   - Pairs that are two: CutAtSplits. A segment matched to one of the two goes to the other if most of its points lie
///     on that. So does one with an unknown persistent id of the thing's class, if the thing has no id yet; the thing
///     then gets it.
///   - Locked things: a segment with an id that is unknown in its session may match a locked thing by overlap, too. An
///     unmatched segment that is no background goes to the locked thing that half of its points lie on.
///   - Segments below tracking.min_score go to the unknown submap.
///   - A thing's segment that would create a submap goes to a thing of its class that it lies on, even if others hide
///     it (MatchCovered).
///   - All others create a submap if they are large enough and not merely the border of a mask; else they go to the
///     unknown submap.
///
/// Ties are broken by submap id, then by table row. Thread-compatible.
class Tracker {
 public:
  Tracker(const MapConfig& config, ThreadPool& pool) : config_(config), pool_(pool) {}

  /// Call before Assign. If one segment covers two things that are known to be two (ObjectPair::AreTwo; for frames with
  /// persistent ids only by verdict) and no other segment shows the second, the points on the second become a segment
  /// of their own, with the same row, for that thing. A few points are not enough, and segments of a thing with its own
  /// grid stay whole. Parts of a segment are consecutive, the largest first.
  void CutAtSplits(const PanopticFrame& frame, const Map& map, std::vector<SegmentBundles>& segments) const;

  /// One assignment for each of `segments` (see Bundler), on the map's grid. Creates submaps in `map`.
  std::vector<Assignment> Assign(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, Map& map);

  /// The overlaps of the last Assign; empty if there was nothing to match.
  [[nodiscard]] const OverlapTable& overlaps() const { return overlaps_; }

 private:
  void MatchThings(const std::vector<SegmentBundles>& segments, const std::vector<bool>& is_open,
                   const PanopticFrame& frame, const OverlapTable& overlaps, const Map& map,
                   std::vector<Assignment>& assignments) const;
  void MatchLocked(const std::vector<SegmentBundles>& segments, const std::vector<const LabelClass*>& classes,
                   const Map& map, std::vector<Assignment>& assignments) const;
  /// Gives things that matched by overlap the persistent ids of the frame's segments.
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

/// Whether a bundle of `a` ends in, or in one of the 26 neighbours of, an end voxel of `b`.
bool Touch(const SegmentBundles& a, const SegmentBundles& b);

}  // namespace dhpmap

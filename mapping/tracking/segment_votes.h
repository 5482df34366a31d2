// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"
#include "mapping/voxels/label_block.h"

namespace dhpmap {

/// What one sighting of each segment of a frame counts at a voxel, in units of TrackingConfig::SightingUnit: of which
/// classes, and of which instances. Both have the same sum.
///   - Not weighed (tracking.weigh_scores): one sighting of its class, which is one of the submap that it goes into.
///   - By its score: as much less, 1/256 at least. One without a score is as sure as those of its frame that have one
///     are on the average, so that neither wins where masks overlap.
///   - By its class scores, where it has them: each of the likeliest few of the submap's kind by its own. Of a thing
///     they are its classes alone. Of a background, one that has a submap of its own and at least a quarter of the most
///     counts for that one's instance, unless somebody has edited one of the two; the rest is the holder's. The class
///     that the segment is said to be of has 1/256 at least, and as much more where it would tie.
/// Refers to frame and map, as they are before anything of the frame is fused.
class FrameVotes {
 public:
  FrameVotes(const PanopticFrame& frame, const Map& map);

  /// Of a segment that goes into `holder`; empty for one without a class, and in the unknown submap.
  LabelHistograms Of(const SegmentInfo& segment, const Submap& holder);

 private:
  LabelHistograms ByClassScores(const SegmentInfo& segment, const SubmapInfo& holder);
  /// Whose instance a background class is evidence for, as a voxel of the holder names it.
  SeenInstance InstanceOf(ClassId class_id, const SubmapInfo& holder);

  const Map& map_;
  float unscored_ = 1;  ///< the score of a segment that has none
  /// Those that were asked for; the unknown one where a class has none, or one that takes nothing.
  std::map<ClassId, SubmapId> backgrounds_;
};

}  // namespace dhpmap

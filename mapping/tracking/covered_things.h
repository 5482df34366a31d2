// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/base/ids.h"
#include "mapping/fusion/segment_bundles.h"
#include "mapping/map/map.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// A thing that lies flat on a larger one has few points to itself: those of its segments count for the larger one, of
/// which more was observed there (see CountOverlaps), in each frame anew, and it would be made in each anew. So a
/// segment that matches nothing is looked at once more, by all of its points that lie on a thing of its class.
class CoveredThings {
 public:
  /// Refers to all of them. `taken`: things that a segment of the frame shows already.
  CoveredThings(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, const Map& map,
                std::vector<SubmapId> taken);

  struct Match {
    SubmapId submap = kUnknownSubmap;  ///< none
    double iou = 0;
  };
  /// The thing of the segment's class that at least half of its points lie on, and with which its IoU is best and above
  /// the threshold (tracking.iou_threshold), the smaller id of equals. It is taken from then on.
  Match Find(const SegmentBundles& segment, ClassId class_id);

 private:
  const PanopticFrame& frame_;
  const std::vector<SegmentBundles>& segments_;
  const Map& map_;
  std::vector<SubmapId> taken_;
};

}  // namespace dhpmap

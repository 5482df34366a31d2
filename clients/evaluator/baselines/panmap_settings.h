// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/sensor/frame.h"

namespace dhpmap::evaluator {

/// Parameters of Panmap that MapConfig does not have. How many points a new submap needs is MapConfig's min_points: at
/// Panmap's own 2000 pixels of 640 x 480 the small things of our data sets would never be mapped.
struct PanmapSettings {
  // Tracking, against active submaps of the segment's class.
  double iou_threshold = 0.1;
  double depth_tolerance_vox = 1.0;

  // Activity. Panmap requires 5 re-observations; but where a network misses or mistakes a sixth of all things anew in
  // each frame, 5 right ones in a row are luck, and most objects are lost: PQ of house about 0.6 with 5, 0.65 with 3,
  // 0.8 with 1 and 0.3 with none, mIoU likewise. So it gets what serves it best.
  int required_reobservations = 1;  ///< in consecutive frames after the first
  int deactivate_after_missed = 5;  ///< consecutive frames

  // Merging of inactive submaps of one class whose surfaces agree.
  double max_error_vox = 1.0;
  double max_conflict = 0.02;  ///< share of the weight of common surface points
  double min_match = 0.02;
  int min_points = 20;  ///< that conflict, or match
  double full_weight = 5000.0;
};

/// Those of the published configurations but for required_reobservations: flat_detectron of Panmap for depth cameras,
/// kitti_panmap of Voxfield Panmap, the nearest there is, for LiDAR. With LiDAR, 3 re-observations do no harm even in
/// the 10 scans that the sequences have: what is made in the last scans stays.
inline PanmapSettings PanmapSettingsFor(const PanopticFrame& frame) {
  PanmapSettings settings;
  if (frame.lidar) {
    settings.iou_threshold = 0.08;
    settings.depth_tolerance_vox = 3.0;
    settings.required_reobservations = 3;
    settings.deactivate_after_missed = 10;
  }
  return settings;
}

}  // namespace dhpmap::evaluator

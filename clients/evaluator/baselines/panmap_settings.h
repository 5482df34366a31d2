// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/sensor/frame.h"

namespace dhpmap::evaluator {

/// Parameters of Panmap beyond MapConfig. A new submap needs MapConfig's min_points: with Panmap's own 2000 pixels of
/// 640 x 480, the small things of our data sets would never be mapped.
struct PanmapSettings {
  // Tracking, for active submaps of the segment's class.
  double iou_threshold = 0.1;
  double depth_tolerance_vox = 1.0;

  // Activity. Panmap requires 5 re-observations. But if a network misses or misclassifies a sixth of all things at
  // random in each frame, 5 correct ones in a row are rare, and most objects are lost: PQ of house is about 0.6 with 5,
  // 0.65 with 3, 0.8 with 1 and 0.3 with none, and mIoU behaves alike. So we use its best value.
  int required_reobservations = 1;  ///< in consecutive frames after the first
  int deactivate_after_missed = 5;  ///< consecutive frames

  // Merging of inactive submaps of one class with matching surfaces.
  double max_error_vox = 1.0;
  double max_conflict = 0.02;  ///< share of the weight of common surface points
  double min_match = 0.02;
  int min_points = 20;  ///< with conflicts or matches
  double full_weight = 5000.0;
};

/// Those of the published configurations, except required_reobservations: Panmap's flat_detectron for depth cameras;
/// for LiDAR the closest one, Voxfield Panmap's kitti_panmap. With LiDAR, 3 re-observations do no harm even with only
/// 10 scans: submaps created in the last scans are kept.
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

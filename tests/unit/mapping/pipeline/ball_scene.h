// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"
#include "tests/support/scenes.h"

// The least that is a map: a ball on a floor, in images of 40 x 30 pixels.

namespace dhpmap::testing {

inline MapInfo BallInfo(int refine_every_frames = 0) {
  MapInfo info;
  info.name = "m";
  info.label_set = MakeLabelSet(1, 1);
  info.config.tracking.min_points_stuff = 20;
  info.config.tracking.min_points_medium = 10;
  info.config.refinement.every_frames = refine_every_frames;
  return info;
}

inline PanopticFrame BallFrameFrom(const Eigen::Vector3d& eye_m, double ball_y_m) {
  constexpr std::uint32_t kBallSegment = 1, kFloorSegment = 2;
  const Scene scene{{{.shape = Solid::Shape::kSphere,
                      .center_m = {2, ball_y_m, 0.4},
                      .size_m = {0.4, 0, 0},
                      .segment = kBallSegment,
                      .color = {200, 0, 0}},
                     {.shape = Solid::Shape::kHalfSpace,
                      .center_m = {0, 0, 0},
                      .size_m = {0, 0, 1},
                      .segment = kFloorSegment,
                      .color = {90, 90, 90}}}};
  const PinholeCamera camera{40, 30, 20, 20, 20, 15};
  PanopticFrame frame = Render(scene, camera, LookAt(eye_m, {2, 0, 0.3}));
  frame.segments = {{.id = SegmentId(kBallSegment), .class_id = ClassId(1)},
                    {.id = SegmentId(kFloorSegment), .class_id = ClassId(2)}};
  return frame;
}

/// Frame `i` of a walk past it, while the ball rolls.
inline PanopticFrame BallFrame(int i) { return BallFrameFrom({0.03 * i, 0, 1.2}, 0.05 * i); }

}  // namespace dhpmap::testing

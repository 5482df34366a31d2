// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>

#include "mapping/pipeline/map_builder.h"
#include "mapping/plausibility/frame_check.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// A room of 6 x 5 x 2.6 m with things in it.
inline Scene FurnishedRoom() {
  using Shape = Solid::Shape;
  const auto wall = [](Eigen::Vector3d at, Eigen::Vector3d normal) {
    return Solid{.shape = Shape::kHalfSpace, .center_m = std::move(at), .size_m = std::move(normal)};
  };
  return {{wall({0, 0, 0}, {0, 0, 1}), wall({0, 0, 2.6}, {0, 0, -1}), wall({-3, 0, 0}, {1, 0, 0}),
           wall({3, 0, 0}, {-1, 0, 0}), wall({0, -2.5, 0}, {0, 1, 0}), wall({0, 2.5, 0}, {0, -1, 0}),
           Solid{.shape = Shape::kBox, .center_m = {1.5, 0.8, 0.4}, .size_m = {0.6, 0.4, 0.4}},
           Solid{.shape = Shape::kBox, .center_m = {2.6, -1.5, 0.9}, .size_m = {0.3, 0.5, 0.9}},
           Solid{.shape = Shape::kBox, .center_m = {-2.2, 1.9, 0.5}, .size_m = {0.5, 0.4, 0.5}},
           Solid{.shape = Shape::kSphere, .center_m = {0.4, -1.2, 0.5}, .size_m = {0.35, 0, 0}}}};
}

constexpr std::int64_t kWalkPeriod_ns = 100'000'000;

/// Of a walk through it that turns by 4 degrees and goes on by 9 cm each time, well away from the map's origin.
inline Transform WalkPose(int i) {
  const double angle = 0.07 * i;
  const Eigen::Vector3d eye(-1.2 + 0.08 * i, -0.6 + 0.04 * i, 1.3);
  return LookAt(eye, eye + Eigen::Vector3d(std::cos(angle), std::sin(angle), -0.25));
}

inline PanopticFrame WalkFrame(int i) {
  static const Scene room = FurnishedRoom();
  PanopticFrame frame = Render(room, SmallCamera(), WalkPose(i));
  frame.camera->segments.clear();
  frame.stamp_ns = (i + 1) * kWalkPeriod_ns;
  return frame;
}

inline MapInfo EmptyMap() {
  MapInfo info;
  info.name = "room";
  return info;
}

/// Fuses it, and says what was found of it.
inline FrameCheck FuseAndCheck(MapBuilder& builder, const PanopticFrame& frame) {
  EXPECT_TRUE(builder.Integrate(frame).ok());
  return builder.TakeCheck();
}

}  // namespace dhpmap::testing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "mapping/plausibility/frame_check.h"
#include "mapping/sensor/frame.h"

namespace dhpmap::testing {

/// What a client does to right frames, written as clients do it, and what it must be told.
struct Mistake {
  FrameFault fault;
  void (*make)(PanopticFrame& frame);
};

/// The pose becomes that of a frame at the same place, of whose axes the camera has these coordinates.
inline void SendPoseOf(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z,
                       PanopticFrame& frame) {
  Eigen::Matrix3d axes;
  axes << x, y, z;
  frame.T_map_sensor.linear() = frame.T_map_sensor.linear() * axes;
}

inline void ScaleCamera(double by, PanopticFrame& frame) {
  PinholeCamera& camera = frame.camera->camera;
  for (double* const value : {&camera.fx_px, &camera.fy_px, &camera.cx_px, &camera.cy_px}) *value *= by;
}

inline std::vector<Mistake> MistakesOfDepthCameras() {
  using Frame = PanopticFrame;
  return {
      {FrameFault::kPoseInverted, [](Frame& frame) { frame.T_map_sensor = frame.T_map_sensor.inverse(); }},
      {FrameFault::kOpenGlAxes,
       [](Frame& frame) {
         SendPoseOf({1, 0, 0}, {0, -1, 0}, {0, 0, -1}, frame);
       }},
      {FrameFault::kBodyAxes,
       [](Frame& frame) {
         SendPoseOf({0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, frame);
       }},
      {FrameFault::kTranslationInMillimetres, [](Frame& frame) { frame.T_map_sensor.translation() *= 1000; }},
      {FrameFault::kIntrinsicsOfHalf, [](Frame& frame) { ScaleCamera(0.5, frame); }},
      {FrameFault::kIntrinsicsOfDouble, [](Frame& frame) { ScaleCamera(2, frame); }},
      {FrameFault::kDepthInMillimetres,
       [](Frame& frame) {
         for (float& depth_m : frame.camera->depth_m) depth_m *= 1000;
       }},
  };
}

inline bool Tells(const FrameCheck& check, FrameFault fault) {
  return std::any_of(check.warnings.begin(), check.warnings.end(),
                     [fault](const FrameWarning& warning) { return warning.fault == fault; });
}

/// All warnings, for a failed test.
inline std::string Told(const FrameCheck& check) {
  std::string told;
  for (const FrameWarning& warning : check.warnings) {
    told.append(FaultName(warning.fault)).append(": ").append(warning.message).append("\n");
  }
  return told;
}

}  // namespace dhpmap::testing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "mapping/base/transform.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// What a client has probably mistaken.
enum class FrameFault : std::uint8_t {
  kDisagrees,     ///< with what the map knows; why is not found
  kPoseInverted,  ///< sensor_from_map in place of map_from_sensor
  kOpenGlAxes,    ///< of a camera that looks along -z, y up
  kBodyAxes,      ///< of a body with x forward, y left, z up, as ROS has them
  kTranslationInMillimetres,
  kIntrinsicsOfHalf,  ///< of an image of half the width and height
  kIntrinsicsOfDouble,
  kDepthInMillimetres,
  kStampRepeated,  ///< the one of the frame before
  kStampWentBack,
};

/// As clients see it: "POSE_INVERTED".
std::string_view FaultName(FrameFault fault);
/// For people: "the pose looks inverted: ...".
std::string_view FaultText(FrameFault fault);

/// What a frame says of its sensor.
struct SensorClaim {
  std::optional<PinholeCamera> camera;  ///< none: a LiDAR
  Transform T_map_sensor = Transform::Identity();
  double metres_per_unit = 1;  ///< of depth

  static SensorClaim Of(const PanopticFrame& frame);
};

/// Those that a sensor's points can tell.
std::span<const FrameFault> GeometricFaults(const SensorClaim& claim);
/// What the claim should have been if that was mistaken; of a geometric fault.
SensorClaim Corrected(const SensorClaim& claim, FrameFault fault);

}  // namespace dhpmap

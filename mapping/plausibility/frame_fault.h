// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "mapping/base/transform.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// The client's probable mistake.
enum class FrameFault : std::uint8_t {
  kDisagrees,     ///< the frame disagrees with the map for an unknown reason
  kPoseInverted,  ///< sensor_from_map instead of map_from_sensor
  kOpenGlAxes,    ///< axes of a camera that looks along -z, y up
  kBodyAxes,      ///< axes of a ROS body: x forward, y left, z up
  kTranslationInMillimetres,
  kIntrinsicsOfHalf,  ///< of an image of half the width and height
  kIntrinsicsOfDouble,
  kDepthInMillimetres,
  kStampRepeated,  ///< equal to that of the previous frame
  kStampWentBack,
};

/// The name in the API: "POSE_INVERTED".
std::string_view FaultName(FrameFault fault);
/// A readable sentence: "the pose looks inverted: ...".
std::string_view FaultText(FrameFault fault);

/// The sensor parameters that a frame claims.
struct SensorClaim {
  std::optional<PinholeCamera> camera;  ///< none: a LiDAR
  Transform T_map_sensor = Transform::Identity();
  double metres_per_unit = 1;  ///< of depth

  static SensorClaim Of(const PanopticFrame& frame);
};

/// The faults that the points of this sensor can reveal.
std::span<const FrameFault> GeometricFaults(const SensorClaim& claim);
/// The claim without this geometric fault.
SensorClaim Corrected(const SensorClaim& claim, FrameFault fault);

}  // namespace dhpmap

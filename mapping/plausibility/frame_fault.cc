// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/plausibility/frame_fault.h"

#include <array>

namespace dhpmap {
namespace {

constexpr double kMetresPerMillimetre = 1e-3;

struct FaultRow {
  std::string_view name, text;
};

/// In the order of the enumeration.
constexpr std::array kRows = {
    FaultRow{"DISAGREES_WITH_MAP", "the frame contradicts what the map knows: its pose is wrong, or much has changed"},
    FaultRow{"POSE_INVERTED", "the pose looks inverted: map_from_sensor takes points of the sensor to the map"},
    FaultRow{"OPENGL_AXES", "the pose looks like one of OpenGL's camera axes: z must be forward and y down"},
    FaultRow{"BODY_AXES",
             "the pose looks like that of a body (x forward, z up), not of its camera (z forward, y down)"},
    FaultRow{"TRANSLATION_IN_MILLIMETRES", "the translation looks like millimetres: it must be in metres"},
    FaultRow{"INTRINSICS_OF_HALF_SIZE", "the intrinsics look like those of an image of half the width and height"},
    FaultRow{"INTRINSICS_OF_DOUBLE_SIZE", "the intrinsics look like those of an image of twice the width and height"},
    FaultRow{"DEPTH_IN_MILLIMETRES", "the depth looks like millimetres: it must be in metres, or have its scale_m"},
    FaultRow{"STAMP_REPEATED", "the frame has the stamp of the one before it in its session"},
    FaultRow{"STAMP_WENT_BACK", "the frame's stamp is before that of the one before it in its session"},
};
static_assert(kRows.size() == static_cast<std::size_t>(FrameFault::kStampWentBack) + 1);

const FaultRow& RowOf(FrameFault fault) { return kRows[static_cast<std::size_t>(fault)]; }

/// Columns: the camera's axes (z forward, y down) in the other's.
Transform WithAxes(const Eigen::Vector3d& x, const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
  Transform T = Transform::Identity();
  T.linear().col(0) = x;
  T.linear().col(1) = y;
  T.linear().col(2) = z;
  return T;
}

/// Integer coordinates are at pixel centres, so that the corner of the image is at -0.5.
PinholeCamera Scaled(PinholeCamera camera, double factor) {
  camera.fx_px *= factor;
  camera.fy_px *= factor;
  camera.cx_px = (camera.cx_px + 0.5) * factor - 0.5;
  camera.cy_px = (camera.cy_px + 0.5) * factor - 0.5;
  return camera;
}

}  // namespace

std::string_view FaultName(FrameFault fault) { return RowOf(fault).name; }
std::string_view FaultText(FrameFault fault) { return RowOf(fault).text; }

SensorClaim SensorClaim::Of(const PanopticFrame& frame) {
  SensorClaim claim;
  if (frame.camera) claim.camera = frame.camera->camera;
  claim.T_map_sensor = frame.T_map_sensor;
  return claim;
}

std::span<const FrameFault> GeometricFaults(const SensorClaim& claim) {
  static constexpr std::array kOfAny = {FrameFault::kPoseInverted, FrameFault::kTranslationInMillimetres};
  static constexpr std::array kOfCamera = {FrameFault::kPoseInverted,     FrameFault::kTranslationInMillimetres,
                                           FrameFault::kOpenGlAxes,       FrameFault::kBodyAxes,
                                           FrameFault::kIntrinsicsOfHalf, FrameFault::kIntrinsicsOfDouble};
  if (claim.camera) return kOfCamera;
  return kOfAny;
}

SensorClaim Corrected(const SensorClaim& claim, FrameFault fault) {
  using Axis = Eigen::Vector3d;
  SensorClaim right = claim;
  switch (fault) {
    case FrameFault::kPoseInverted: right.T_map_sensor = claim.T_map_sensor.inverse(); break;
    case FrameFault::kOpenGlAxes:
      right.T_map_sensor = claim.T_map_sensor * WithAxes(Axis::UnitX(), -Axis::UnitY(), -Axis::UnitZ());
      break;
    case FrameFault::kBodyAxes:
      right.T_map_sensor = claim.T_map_sensor * WithAxes(-Axis::UnitY(), -Axis::UnitZ(), Axis::UnitX());
      break;
    case FrameFault::kTranslationInMillimetres: right.T_map_sensor.translation() *= kMetresPerMillimetre; break;
    case FrameFault::kIntrinsicsOfHalf: right.camera = Scaled(*claim.camera, 2); break;
    case FrameFault::kIntrinsicsOfDouble: right.camera = Scaled(*claim.camera, 0.5); break;
    case FrameFault::kDepthInMillimetres: right.metres_per_unit = kMetresPerMillimetre; break;
    case FrameFault::kDisagrees:
    case FrameFault::kStampRepeated:
    case FrameFault::kStampWentBack: break;
  }
  return right;
}

}  // namespace dhpmap

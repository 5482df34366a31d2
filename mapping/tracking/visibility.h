// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mapping/sensor/frame.h"
#include "mapping/submap/bounding_sphere.h"

namespace dhpmap {

/// Whether any part of the sphere (map frame) may be in the sensor's view: within range and, for a camera, not wholly
/// outside a border of the image. Conservative.
bool MayBeInView(const PanopticFrame& frame, double max_range_m, const BoundingSphere& sphere);

/// Whether a frame should show an object at a place. Refers to the frame, which must outlive it. Thread-compatible.
class FrameSight {
 public:
  FrameSight(const PanopticFrame& frame, double max_range_m) : frame_(frame), max_range_m_(max_range_m) {}

  /// Whether the centre of a sphere (map frame) should have been seen: in range, inside the image, and not occluded by
  /// the measured depth. False for pixels without a return. For a LiDAR, the beam nearest to the centre decides, among
  /// beams that meet the sphere within kMostBeamGap_rad; false without one, as in a scan cropped to a camera's image.
  [[nodiscard]] bool ShouldBeSeen(const BoundingSphere& sphere);

  /// Half the gap between rings of common scanners, and more than the jitter of their beams.
  static constexpr double kMostBeamGap_rad = 0.035;

 private:
  [[nodiscard]] bool IsSeenByCamera(const Eigen::Vector3d& p_sensor_m, double radius_m) const;
  [[nodiscard]] bool IsMetByBeam(const Eigen::Vector3d& p_sensor_m, double radius_m);
  void SortBeams();

  const PanopticFrame& frame_;
  double max_range_m_;
  // The scan's beams, hashed on demand by cells of the unit cube around their directions: the first of each cell, and
  // the next of the same cell for each.
  std::vector<std::int32_t> first_, next_;
};

}  // namespace dhpmap

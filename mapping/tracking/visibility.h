// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mapping/sensor/frame.h"
#include "mapping/submap/bounding_sphere.h"

namespace dhpmap {

/// True if any part of the sphere (map frame) may be in the sensor's view: within range and, for a camera, not wholly
/// on the outer side of a border of the image.
bool MayBeInView(const PanopticFrame& frame, double max_range_m, const BoundingSphere& sphere);

/// Whether a frame would show what is there, if it is there. Looks at the frame, which must outlive it.
/// Thread-compatible.
class FrameSight {
 public:
  FrameSight(const PanopticFrame& frame, double max_range_m) : frame_(frame), max_range_m_(max_range_m) {}

  /// True if the centre of a sphere (map frame) should have been seen: in range, inside the image, and not hidden
  /// behind what was measured there. Pixels without a return say nothing, so the answer is then false. LiDAR: the beam
  /// that passes nearest to the centre, of those that meet the sphere and are within kMostBeamGap_rad; without one, as
  /// where the scan was cropped to a camera's image, the answer is false.
  [[nodiscard]] bool ShouldBeSeen(const BoundingSphere& sphere);

  /// Half of what scanners leave between their rings, and more than their beams move about.
  static constexpr double kMostBeamGap_rad = 0.035;

 private:
  [[nodiscard]] bool IsSeenByCamera(const Eigen::Vector3d& p_sensor_m, double radius_m) const;
  [[nodiscard]] bool IsMetByBeam(const Eigen::Vector3d& p_sensor_m, double radius_m);
  void SortBeams();

  const PanopticFrame& frame_;
  double max_range_m_;
  // The scan's beams by cells of the unit cube around their directions, once somebody asks: the first of each cell, and
  // the next of the same for each.
  std::vector<std::int32_t> first_, next_;
};

}  // namespace dhpmap

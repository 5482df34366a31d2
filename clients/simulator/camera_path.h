// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mapping/base/transform.h"

namespace dhpmap::simulator {

/// A closed path through all rooms of the apartment at eye level, which shows the furniture from several sides: smooth
/// in position and direction, at least kClearance_m from everything. Immutable.
class CameraPath {
 public:
  static constexpr double kClearance_m = 0.25;

  CameraPath();
  /// Pose of the camera (z forward, x right, y down) after `share` of the path, 0..1; 0 and 1 are the same pose.
  [[nodiscard]] Transform PoseAt(double share) const;
  /// Pose of a frame of a recording whose `num_frames` cover the path once.
  [[nodiscard]] Transform PoseOfFrame(int frame, int num_frames) const;
  [[nodiscard]] double length_m() const { return length_m_; }

 private:
  /// Eye position (x, y, z) and direction (yaw from +x towards +y, pitch up; radians).
  using State = Eigen::Matrix<double, 5, 1>;

  [[nodiscard]] State StateAt(double time) const;

  std::vector<State> states_;  ///< the last one is the first after a full round
  std::vector<double> times_;
  double length_m_ = 0;
};

}  // namespace dhpmap::simulator

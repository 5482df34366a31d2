// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mapping/map/map_config.h"
#include "mapping/plausibility/frame_fault.h"
#include "mapping/sensor/frame.h"

namespace dhpmap {

/// Of a sample; 0 of nothing.
inline double Share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

/// A few hundred readings of a frame, evenly spread over its image or scan, for any size. Deterministic.
class FrameSample {
 public:
  explicit FrameSample(const PanopticFrame& frame);

  /// With a return.
  [[nodiscard]] std::size_t num_returns() const { return readings_.size(); }
  /// The readings that are in range under a claim, in the sensor's frame.
  [[nodiscard]] std::vector<Eigen::Vector3f> PointsInRange(const SensorClaim& claim,
                                                           const IntegrationConfig& config) const;

 private:
  std::vector<Eigen::Vector3f> readings_;  ///< of a camera u, v and depth; of a LiDAR a point
};

}  // namespace dhpmap

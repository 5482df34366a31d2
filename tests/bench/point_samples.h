// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mapping/sensor/frame.h"

namespace dhpmap {

/// A measured point with what the ground truth says of it.
struct PointSample {
  Eigen::Vector3f p_map_m;
  std::uint32_t segment = 0;  ///< persistent id of the object
  bool at_edge = false;       ///< another object is near
  float range_m = 0;          ///< from the sensor
};

struct SampleOptions {
  int step = 7;                                 ///< every so many pixels in u and v, or points of a scan
  double min_depth_m = 0.3, max_depth_m = 4.0;  ///< along the optical axis; of a scan: range
  int edge_px = 4;                              ///< how near another object's pixel makes an edge
  double edge_m = 0.3;                          ///< the same for points of a scan
};

/// Samples of one frame whose segment is not 0.
std::vector<PointSample> SamplePoints(const PanopticFrame& frame, const SampleOptions& options);

}  // namespace dhpmap

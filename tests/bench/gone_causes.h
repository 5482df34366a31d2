// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/query/distance_query.h"
#include "mapping/sensor/frame.h"

namespace dhpmap::bench {

/// A point measured on what has gone since.
struct GonePoint {
  Eigen::Vector3d p_map_m;
  std::uint32_t instance;  ///< true
};

/// Depth images of the second walk, to count by single pixels how often a point was looked through.
class SecondWalk {
 public:
  void Add(const PanopticFrame& frame) {
    if (views_.empty()) first_stamp_ns_ = frame.stamp_ns;
    views_.push_back({frame.T_map_sensor.inverse(), *frame.camera});
  }
  [[nodiscard]] std::int64_t first_stamp_ns() const { return first_stamp_ns_; }
  /// Frames within `max_range_m` of which the pixel of the point measured farther than `behind_m` behind it.
  [[nodiscard]] int CountPast(const Eigen::Vector3d& p_map_m, double behind_m, double max_range_m) const;

 private:
  struct View {
    Transform T_sensor_map;
    DepthCameraData data;
  };
  std::int64_t first_stamp_ns_ = 0;
  std::vector<View> views_;
};

/// Prints why points of what is gone still have a surface: how often they were looked through, who holds the surface,
/// and how many looks the map counts there. `nearest`: of each, the nearest surface of `after`, which is there.
/// `num_asked`: points of what is gone, with a surface and without.
void PrintGoneCauses(const MapSnapshot& after, const SecondWalk& walk, const std::vector<GonePoint>& points,
                     const std::vector<SurfaceDistance>& nearest, std::size_t num_asked);

}  // namespace dhpmap::bench

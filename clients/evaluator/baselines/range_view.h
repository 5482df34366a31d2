// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mapping/map/map_config.h"
#include "mapping/sensor/frame.h"

namespace dhpmap::evaluator {

/// The measurement in one direction.
struct RangeReading {
  float range_m = 0;  ///< from the sensor's origin
  int row = -1;       ///< of the frame's segment table; -1: no known object
  Color color;
};

/// A frame as a range image, into which voxels are projected (Panmap's projective integrator). Depth images keep their
/// pixels. A scan becomes a spherical image of 0.35 degrees per column and 64 rows from +3 to -25 degrees with the
/// nearest point in each pixel: the sensor model of Voxfield Panmap for KITTI. Readings out of range are left out.
class RangeView {
 public:
  /// The frame must be valid (ValidateFrame), and is not needed afterwards.
  RangeView(const PanopticFrame& frame, const IntegrationConfig& config);

  /// False without a measurement or outside the image. Ranges are bilinear if the four surrounding pixels agree within
  /// 20 cm, else those of the nearest pixel with a reading; so is the segment ("adaptive" interpolation).
  [[nodiscard]] bool Read(const Eigen::Vector3f& p_sensor_m, RangeReading& reading) const;

  /// The weight of one observation of a voxel: the number of rays through it, times the weight of a ray.
  [[nodiscard]] float Weight(const Eigen::Vector3f& p_sensor_m, float voxel_size_m) const;

 private:
  void FillFromCamera(const PanopticFrame& frame);
  void FillFromScan(const PanopticFrame& frame);
  void Put(std::size_t pixel, float range_m, int row, Color color);
  [[nodiscard]] bool ProjectToImage(const Eigen::Vector3f& p_sensor_m, float& u, float& v) const;
  [[nodiscard]] float RayWeight(float depth_m, float range_m) const;

  IntegrationConfig config_;
  bool is_spherical_ = false;
  PinholeCamera camera_;        // for a spherical image only its size
  std::vector<float> range_m_;  // 0: no measurement
  std::vector<int> row_;
  std::vector<Color> color_;
};

}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "mapping/base/thread_pool.h"
#include "mapping/sensor/frame.h"
#include "mapping/space/cell.h"
#include "mapping/space/lidar_bins.h"
#include "mapping/space/lidar_kernel.h"
#include "mapping/space/look_options.h"
#include "mapping/space/sight_pyramid.h"

namespace dhpmap {

/// What a LiDAR looks through. Its scan is points without an order, so directions are cut into bins, of
/// which each has the least range of its points. Bins between two beams take the nearer one's, where the beams lie no
/// farther apart than beams of this scan do. A voxel is free if its centre lies before that of its own and all eight
/// bins around: all beams beside it go farther, and none of them is missing. Minus the truncation, and not beyond the
/// range. The image is as wide as the scan. Keeps its buffers from frame to frame. Thread-compatible.
class LidarView {
 public:
  /// `R_sensor_grid`: from the axes of the map's grid to the scanner's.
  void Build(const LidarData& data, const Eigen::Matrix3d& R_sensor_grid, const LookOptions& options, ThreadPool& pool);

  /// A box, in voxels from the sensor along the axes of the grid, outside of which no voxel centre is free.
  [[nodiscard]] Box Reach() const;

  void Classify(const CellBatch& cells, CellSights& sights) const;
  /// Whether all bins that a ball may cover have beams around, all of which go farther than the ball and the
  /// truncation.
  void LookPast(const BallBatch& balls, std::array<bool, kLanes>& is_past) const;
  /// See TestOctant.
  void Test(float x, float y, float z, std::array<std::uint8_t, kOctantVoxels>& is_free) const {
    TestOctant(x, y, z, geometry_, image_.limit_vox.data(), is_free);
  }

  [[nodiscard]] const SightImage& image() const { return image_; }
  /// The bins of the image.
  [[nodiscard]] const LidarWindow& window() const { return bins_.window(); }

 private:
  void BuildGeometry(const Eigen::Matrix3d& R_sensor_grid);
  void SpreadBins(ThreadPool& pool);
  /// Over columns of all around, which may go on beyond either edge, but less than once around; rows are those of the
  /// image. What is beyond the image has no limit.
  [[nodiscard]] SightPyramid::Span Over(int first_column, int last_column, int v0, int v1) const {
    const int u0 = first_column - window().first_column, u1 = last_column - window().first_column;
    if (u0 >= 0 && u1 < window().width) return pyramid_.Over(u0, v0, u1, v1);
    return OverEdge(first_column, last_column, v0, v1);
  }
  [[nodiscard]] SightPyramid::Span OverEdge(int first_column, int last_column, int v0, int v1) const;

  LidarGeometry geometry_{};
  LidarBins bins_;
  SightImage image_;  ///< the bins, spread to those around
  SightPyramid pyramid_;
};

}  // namespace dhpmap

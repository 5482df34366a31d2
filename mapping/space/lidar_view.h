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

/// The space that a LiDAR looks through. A scan's points have no order, so they are sorted into bins of direction; the
/// limit of a bin is the minimum range of its points. A bin between two beams takes the smaller limit if the beams are
/// no farther apart than usual in this scan. A voxel is free if its centre lies before the limits of its own bin and
/// the eight around it, so all neighbouring beams exist and go farther. Limits are the range minus the truncation, at
/// most the maximum range. The image is as wide as the scan. Keeps its buffers from frame to frame. Thread-compatible.
class LidarView {
 public:
  /// `R_sensor_grid`: from the axes of the map's grid to the scanner's.
  void Build(const LidarData& data, const Eigen::Matrix3d& R_sensor_grid, const LookOptions& options, ThreadPool& pool);

  /// A box, in voxels from the sensor along the axes of the grid. No voxel centre outside is free.
  [[nodiscard]] Box Reach() const;

  void Classify(const CellBatch& cells, CellSights& sights) const;
  /// Whether all bins that a ball may cover are surrounded by beams that go farther than the ball plus the truncation.
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
  /// Bounds over columns, which may continue beyond either edge, but less than once around, and over rows of the image.
  /// Beyond the image there is no limit.
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

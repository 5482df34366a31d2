// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/sensor/frame.h"
#include "mapping/space/camera_kernel.h"
#include "mapping/space/cell.h"
#include "mapping/space/look_options.h"
#include "mapping/space/sight_pyramid.h"

namespace dhpmap {

/// The space that a depth camera looks through. A voxel is free if its centre lies before the limit of its pixel in an
/// image of half the resolution. The limit is the minimum of 2 x 2 depths (three of them returns), holes closed, minus
/// the truncation along the ray, at most the range. Keeps its buffers from frame to frame. Thread-compatible.
class CameraView {
 public:
  /// `R_camera_grid`: from the axes of the map's grid to the camera's.
  void Build(const DepthCameraData& data, const Eigen::Matrix3d& R_camera_grid, const LookOptions& options,
             ThreadPool& pool);

  /// A box, in voxels from the sensor along the axes of the grid. No voxel centre outside is free.
  [[nodiscard]] Box Reach() const;

  void Classify(const CellBatch& cells, CellSights& sights) const;
  /// Whether all pixels that a ball may cover are in the image and see farther than the ball plus the truncation.
  void LookPast(const BallBatch& balls, std::array<bool, kLanes>& is_past) const;
  /// See TestOctant.
  void Test(float x, float y, float z, std::array<std::uint8_t, kOctantVoxels>& is_free) const {
    TestOctant(x, y, z, geometry_, image_.limit_vox.data(), is_free);
  }

  [[nodiscard]] const SightImage& image() const { return image_; }

 private:
  /// Whether all limits in a rectangle of pixels, u1 and v1 included, are beyond `far_vox`. May be false for a large
  /// rectangle if a pixel near it has a smaller limit.
  [[nodiscard]] bool AllSeeFartherThan(float far_vox, int u0, int v0, int u1, int v1) const;
  void BuildImage(const DepthCameraData& data, const LookOptions& options, ThreadPool& pool);
  void BuildGeometry(const PinholeCamera& camera, const Eigen::Matrix3d& R_camera_grid);

  CameraGeometry geometry_{};
  SightImage image_;
  SightPyramid pyramid_;
  std::vector<float> raw_;  ///< limits before holes are closed, with a border
};

}  // namespace dhpmap

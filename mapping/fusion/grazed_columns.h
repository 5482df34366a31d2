// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "mapping/base/grid.h"
#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// The voxels about the end of a ray that grazes a surface so flatly that its band stays on one side of it: without
/// those on the other side no cell around the end is complete, and a measured road has no surface. Three columns across
/// the plane, at the end and a voxel before and behind it, as far as the plane was seen there.
class GrazedColumns {
 public:
  /// A column's voxels lie at most so far from the end's voxel, along each axis.
  static constexpr int kReach_vox = 3;

  struct Voxel {
    VoxelIndex offset;  ///< from the voxel that holds the sensor's origin
    float distance_m;   ///< of its centre to the plane
  };

  /// Whether a ray along `direction` (unit) grazes the plane of its bundle, which was seen about its end, so flatly.
  static bool AreNeeded(const TangentPlane& plane, const Eigen::Vector3f& direction) {
    return (plane.before_m > 0 || plane.behind_m > 0) && -plane.normal.dot(direction) < kFlatCosine;
  }

  /// Those within RayBand::kCellReach_vox of the plane. `end_m` as in Bundle; `sensor_offset_vox`: of the sensor within
  /// its voxel, 0..1.
  GrazedColumns(const TangentPlane& plane, const Eigen::Vector3f& end_m, const Eigen::Vector3f& sensor_offset_vox,
                float voxel_size_m);

  [[nodiscard]] const Voxel* begin() const { return voxels_.data(); }
  [[nodiscard]] const Voxel* end() const { return voxels_.data() + num_; }

 private:
  /// Below, a band of a block's side before and behind the end does not reach from corner to corner of the cells there.
  static constexpr float kFlatCosine = 1.5f / kBlockSide;

  std::array<Voxel, 15> voxels_;
  std::size_t num_ = 0;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "mapping/base/grid.h"
#include "mapping/fusion/segment_bundles.h"

namespace dhpmap {

/// The voxels around the end of a ray whose band stays on one side of a surface, because the ray grazes it. Without
/// voxels on the other side no cell around the end is complete, and a measured road has no surface. These are three
/// columns across the plane: at the end, and a voxel before and behind it, as far as the plane was seen there.
class GrazedColumns {
 public:
  /// Largest distance of a column's voxels from the end's voxel, along each axis.
  static constexpr int kReach_vox = 3;

  struct Voxel {
    VoxelIndex offset;  ///< from the voxel that holds the sensor's origin
    float distance_m;   ///< of its centre to the plane
  };

  /// Whether a ray along `direction` (unit) grazes its bundle's plane so flatly, and the plane was seen around the end.
  static bool AreNeeded(const TangentPlane& plane, const Eigen::Vector3f& direction) {
    return (plane.before_m > 0 || plane.behind_m > 0) && -plane.normal.dot(direction) < kFlatCosine;
  }

  /// The columns' voxels within RayBand::kCellReach_vox of the plane. `end_m` as in Bundle; `sensor_offset_vox`: the
  /// sensor's position in its voxel, 0..1.
  GrazedColumns(const TangentPlane& plane, const Eigen::Vector3f& end_m, const Eigen::Vector3f& sensor_offset_vox,
                float voxel_size_m);

  [[nodiscard]] const Voxel* begin() const { return voxels_.data(); }
  [[nodiscard]] const Voxel* end() const { return voxels_.data() + num_; }

 private:
  /// Below this cosine, a band of one block's side before and behind the end does not span the cells there.
  static constexpr float kFlatCosine = 1.5f / kBlockSide;

  std::array<Voxel, 15> voxels_;
  std::size_t num_ = 0;
};

}  // namespace dhpmap

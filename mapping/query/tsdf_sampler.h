// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "mapping/map/submap.h"

namespace dhpmap {

/// Reads the TSDF of one submap at one place after another: the faster, the closer together they are. Refers to the
/// submap, which nobody writes to meanwhile. Belongs to one thread.
class TsdfSampler {
 public:
  explicit TsdfSampler(const Submap& submap);

  /// The value of a voxel, in metres; NaN: not observed.
  [[nodiscard]] float At(VoxelIndex voxel);

  struct Sample {
    bool is_known = false;  ///< false: one of the eight voxels around was not observed, and nothing else means anything
    float distance_m = 0;
    Eigen::Vector3f gradient = Eigen::Vector3f::Zero();  ///< of the distance, submap frame; not of unit length
  };
  /// Trilinear between the centres of the eight voxels around a point of the submap's frame (finite, within the range
  /// of the grid).
  [[nodiscard]] Sample Between(const Eigen::Vector3d& p_submap);

 private:
  void GoTo(BlockIndex first);

  const Submap* submap_;
  double per_voxel_m_;
  BlockIndex first_;                           ///< of the blocks at hand
  std::array<const BlockEntry*, 8> blocks_{};  ///< from `first_` on, x fastest; null: there is none
  bool is_anywhere_ = false;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>

#include "mapping/submap/submap.h"

namespace dhpmap::testing {

/// Reads the TSDF of one submap at one place after another: the faster, the closer together they are. What a flat map
/// gives who asks for nothing else, to compare queries with. Refers to the submap, which nobody writes to meanwhile.
/// Belongs to one thread.
class TsdfSampler {
 public:
  explicit TsdfSampler(const Submap& submap) : submap_(&submap), per_voxel_m_(1 / submap.info().voxel_size_m) {}

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
  /// std::floor is a call where the processor may be an old one.
  static int FloorOf(double x) {
    const int whole = static_cast<int>(x);
    return whole - (x < whole ? 1 : 0);
  }
  void GoTo(BlockIndex first);

  const Submap* submap_;
  double per_voxel_m_;
  BlockIndex first_;                           ///< of the blocks at hand
  std::array<const BlockEntry*, 8> blocks_{};  ///< from `first_` on, x fastest; null: there is none
  bool is_anywhere_ = false;
};

inline void TsdfSampler::GoTo(BlockIndex first) {
  if (is_anywhere_ && first == first_) return;
  for (int k = 0; k < 8; ++k) {
    const BlockEntry* block =
        submap_->blocks().Find({first.x + (k & 1), first.y + (k >> 1 & 1), first.z + (k >> 2 & 1)});
    blocks_[static_cast<std::size_t>(k)] = block == nullptr || block->tsdf == nullptr ? nullptr : block;
  }
  first_ = first;
  is_anywhere_ = true;
}

inline float TsdfSampler::At(VoxelIndex voxel) {
  GoTo(BlockOf(voxel));
  const BlockEntry* block = blocks_[0];
  const int linear = LinearIndex(voxel);
  if (block == nullptr || !block->Shows(linear)) return std::numeric_limits<float>::quiet_NaN();
  return block->tsdf->distance_m[static_cast<std::size_t>(linear)];
}

inline TsdfSampler::Sample TsdfSampler::Between(const Eigen::Vector3d& p_submap) {
  // In voxels from the centre of the least of the eight.
  const Eigen::Vector3d at = p_submap * per_voxel_m_ - Eigen::Vector3d::Constant(0.5);
  const VoxelIndex low{FloorOf(at.x()), FloorOf(at.y()), FloorOf(at.z())};
  GoTo(BlockOf(low));
  constexpr int kLast = kBlockSide - 1;
  const int in_block[3] = {low.x & kLast, low.y & kLast, low.z & kLast};
  float value[8];
  for (int k = 0; k < 8; ++k) {
    const int x = in_block[0] + (k & 1), y = in_block[1] + (k >> 1 & 1), z = in_block[2] + (k >> 2 & 1);
    const BlockEntry* block = blocks_[static_cast<std::size_t>((x >> 3) | (y >> 3) << 1 | (z >> 3) << 2)];
    const int linear = LinearIndex({x, y, z});
    if (block == nullptr || !block->Shows(linear)) return {};
    value[k] = block->tsdf->distance_m[static_cast<std::size_t>(linear)];
  }
  static_assert(kBlockSideLog2 == 3);
  const Eigen::Vector3f part(static_cast<float>(at.x() - low.x), static_cast<float>(at.y() - low.y),
                             static_cast<float>(at.z() - low.z));
  const float x = part.x(), y = part.y(), z = part.z();
  float along_x[4], slope_x[4];  // at the corners in y and z
  for (std::size_t k = 0; k < 4; ++k) {
    slope_x[k] = value[2 * k + 1] - value[2 * k];
    along_x[k] = value[2 * k] + x * slope_x[k];
  }
  const float low_z = along_x[0] + y * (along_x[1] - along_x[0]), high_z = along_x[2] + y * (along_x[3] - along_x[2]);
  Sample sample;
  sample.is_known = true;
  sample.distance_m = low_z + z * (high_z - low_z);
  const float dx = (1 - z) * ((1 - y) * slope_x[0] + y * slope_x[1]) + z * ((1 - y) * slope_x[2] + y * slope_x[3]);
  const float dy = (1 - z) * (along_x[1] - along_x[0]) + z * (along_x[3] - along_x[2]);
  sample.gradient = Eigen::Vector3f(dx, dy, high_z - low_z) * static_cast<float>(per_voxel_m_);
  return sample;
}

}  // namespace dhpmap::testing

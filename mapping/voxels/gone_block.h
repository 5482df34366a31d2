// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "mapping/voxels/part_id.h"
#include "mapping/voxels/voxel_mask.h"

namespace dhpmap {

/// Where a sensor looked from, and when.
struct Viewpoint {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< map frame
  std::int64_t stamp_ns = 0;                             ///< the sensor's clock
};

/// How often sensors have looked through where a block has a surface: a count of 0 to 3 a voxel, beside the TSDF, which
/// stays as it was observed. A voxel is contradicted at 3: then there is nothing any longer, whatever the TSDF says. To
/// observe it anew begins at 0. Thread-compatible.
///
/// Each viewpoint counts once: frames from where the last one that counted stood, soon after, make the same errors.
class GoneBlock {
 public:
  static constexpr int kContradicted = 3;
  static constexpr double kDistinct_m = 0.1;
  static constexpr std::int64_t kDistinct_ns = 1'000'000'000;

  PartId part_id;  ///< of this block; no part of what it says

  GoneBlock() = default;
  /// As it was stored.
  GoneBlock(const VoxelMask& low, const VoxelMask& high, const Viewpoint& last) : low_(low), high_(high), last_(last) {}

  /// Whether no voxel counts anything.
  [[nodiscard]] bool empty() const;
  [[nodiscard]] int Count(int linear) const { return Bit(low_, linear) + 2 * Bit(high_, linear); }
  [[nodiscard]] bool IsContradicted(int linear) const { return Count(linear) == kContradicted; }
  [[nodiscard]] VoxelMask Contradicted() const;
  /// The bits of the counts.
  [[nodiscard]] const VoxelMask& low() const { return low_; }
  [[nodiscard]] const VoxelMask& high() const { return high_; }
  /// The view that counted last; meaningless while this is empty.
  [[nodiscard]] const Viewpoint& last() const { return last_; }

  /// Whether what is seen from there counts: a tenth of a metre or a second from the last view that did.
  [[nodiscard]] bool IsDistinct(const Viewpoint& view) const;
  /// Counts voxels up. Returns how many of them that made contradicted.
  int Raise(const VoxelMask& voxels, const Viewpoint& view);
  /// Begins at 0 for a voxel.
  void Forget(int linear) { Set(linear, 0); }
  void Set(int linear, int count);

  [[nodiscard]] std::size_t MemoryBytes() const { return sizeof(*this); }
  bool operator==(const GoneBlock& other) const;

 private:
  static int Bit(const VoxelMask& mask, int linear) {
    return static_cast<int>(mask[static_cast<std::size_t>(linear >> 6)] >> (linear & 63) & 1u);
  }

  VoxelMask low_{}, high_{};
  Viewpoint last_;
};

}  // namespace dhpmap

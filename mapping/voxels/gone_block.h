// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "mapping/voxels/part_id.h"
#include "mapping/voxels/voxel_mask.h"

namespace dhpmap {

/// Position and time of a sensor's view.
struct Viewpoint {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< map frame
  std::int64_t stamp_ns = 0;                             ///< the sensor's clock
};

/// How often sensors have looked through the surface of a block: a count of 0 to 3 per voxel. The TSDF stays as
/// observed. A voxel with a count of 3 is contradicted: its surface is gone, whatever the TSDF says. Observing it again
/// resets the count to 0. Thread-compatible.
///
/// Each viewpoint counts once, because frames from nearly the same place and time make the same errors.
class GoneBlock {
 public:
  static constexpr int kContradicted = 3;
  static constexpr double kDistinct_m = 0.1;
  static constexpr std::int64_t kDistinct_ns = 1'000'000'000;

  PartId part_id;  ///< identity of this object; not part of its value

  GoneBlock() = default;
  /// From stored values.
  GoneBlock(const VoxelMask& low, const VoxelMask& high, const Viewpoint& last) : low_(low), high_(high), last_(last) {}

  /// Whether all counts are 0.
  [[nodiscard]] bool empty() const;
  [[nodiscard]] int Count(int linear) const { return Bit(low_, linear) + 2 * Bit(high_, linear); }
  [[nodiscard]] bool IsContradicted(int linear) const { return Count(linear) == kContradicted; }
  [[nodiscard]] VoxelMask Contradicted() const;
  /// Low bits of the counts.
  [[nodiscard]] const VoxelMask& low() const { return low_; }
  [[nodiscard]] const VoxelMask& high() const { return high_; }
  /// The last view that counted; meaningless if this is empty.
  [[nodiscard]] const Viewpoint& last() const { return last_; }

  /// Whether a view counts: at least a tenth of a metre or a second from the last one that did.
  [[nodiscard]] bool IsDistinct(const Viewpoint& view) const;
  /// Increments the counts of `voxels`. Returns how many voxels became contradicted.
  int Raise(const VoxelMask& voxels, const Viewpoint& view);
  /// Resets a voxel's count to 0.
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

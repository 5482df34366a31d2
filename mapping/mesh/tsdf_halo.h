// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "mapping/map/block_table.h"

namespace dhpmap {

/// Distances of a block with one voxel around it, NaN where not observed: a copy to take slopes from without looking up
/// blocks for each voxel.
class TsdfHalo {
 public:
  static constexpr int kStride[3] = {1, kBlockSide + 2, (kBlockSide + 2) * (kBlockSide + 2)};

  TsdfHalo(const BlockTable& blocks, BlockIndex index) {
    distance_m_.fill(std::numeric_limits<float>::quiet_NaN());
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const BlockEntry* entry = blocks.Find({index.x + dx, index.y + dy, index.z + dz});
          if (entry != nullptr && entry->tsdf != nullptr) Copy(*entry->tsdf, dx, dy, dz);
        }
      }
    }
  }

  /// Voxel coordinates in the block, -1 to 8.
  [[nodiscard]] static int Position(int x, int y, int z) {
    return (x + 1) * kStride[0] + (y + 1) * kStride[1] + (z + 1) * kStride[2];
  }
  [[nodiscard]] float At(int position) const { return distance_m_[position]; }
  /// Change of the distance over one voxel along an axis, from the neighbours there are.
  [[nodiscard]] float Slope(int position, int axis) const {
    const float here = At(position), below = At(position - kStride[axis]), above = At(position + kStride[axis]);
    if (!std::isnan(below) && !std::isnan(above)) return 0.5f * (above - below);
    if (!std::isnan(above)) return above - here;
    return std::isnan(below) ? 0.0f : here - below;
  }

 private:
  void Copy(const TsdfBlock& block, int dx, int dy, int dz) {
    const auto first = [](int d) { return d < 0 ? -1 : d * kBlockSide; };
    const auto end = [](int d) { return d < 0 ? 0 : d * kBlockSide + (d > 0 ? 1 : kBlockSide); };
    for (int z = first(dz); z < end(dz); ++z) {
      for (int y = first(dy); y < end(dy); ++y) {
        const int from = LinearIndex({first(dx), y, z}), to = Position(first(dx), y, z);
        if (dx == 0) CopyRow<kBlockSide>(block, from, to);
        else CopyRow<1>(block, from, to);
      }
    }
  }

  template <int kCount>  // known to the compiler, which then needs no branches
  void CopyRow(const TsdfBlock& block, int from, int to) {
    for (int i = 0; i < kCount; ++i) {
      distance_m_[to + i] = block.IsObserved(from + i) ? block.distance_m[from + i] : distance_m_[to + i];
    }
  }

  std::array<float, (kBlockSide + 2) * (kBlockSide + 2) * (kBlockSide + 2)> distance_m_;
};

}  // namespace dhpmap

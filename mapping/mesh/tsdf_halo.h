// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>

#include "mapping/mesh/halo.h"
#include "mapping/voxels/slope.h"

namespace dhpmap {

/// Distances of a block with one voxel around it, NaN where not observed: a copy to take slopes from.
class TsdfHalo {
 public:
  explicit TsdfHalo(const Halo::Blocks& blocks) {
    distance_m_.fill(std::numeric_limits<float>::quiet_NaN());
    Halo::VisitRows(blocks, [this](const BlockEntry& entry, int linear, int position, auto count) {
      if (entry.tsdf == nullptr) return;
      const TsdfBlock& tsdf = *entry.tsdf;
      for (int i = 0; i < count; ++i) {
        float& distance_m = distance_m_[position + i];
        distance_m = tsdf.IsObserved(linear + i) ? tsdf.distance_m[linear + i] : distance_m;
      }
    });
  }

  [[nodiscard]] float At(int position) const { return distance_m_[position]; }
  /// See Slope in mapping/map.
  [[nodiscard]] float Slope(int position, int axis) const {
    const int stride = Halo::kStride[axis];
    return dhpmap::Slope(At(position - stride), At(position), At(position + stride));
  }

 private:
  std::array<float, Halo::kVoxels> distance_m_;
};

}  // namespace dhpmap

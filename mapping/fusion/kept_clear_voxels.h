// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unordered_map>
#include <vector>

#include "mapping/map/kept_clear.h"
#include "mapping/submap/submap.h"
#include "mapping/voxels/voxel_mask.h"

namespace dhpmap {

/// The voxels of a submap's grid with their centres in ignored regions, computed by block on demand. Thread-compatible;
/// refers to the regions.
class KeptClearVoxels {
 public:
  KeptClearVoxels(const KeptClear& kept_clear, const SubmapInfo& info)
      : kept_clear_(kept_clear), T_map_submap_(info.T_map_submap), voxel_size_m_(info.voxel_size_m) {}

  /// Whether the block or one of its 26 neighbours may contain one.
  [[nodiscard]] bool MayBeAround(BlockIndex block) const;
  /// Null if the block has none. Valid as long as this.
  const VoxelMask* In(BlockIndex block);

 private:
  const KeptClear& kept_clear_;
  const Transform T_map_submap_;
  const double voxel_size_m_;
  std::unordered_map<BlockIndex, VoxelMask, BlockIndexHash> masks_;
};

}  // namespace dhpmap

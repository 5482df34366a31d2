// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/surface_voxels.h"

#include <cmath>

namespace dhpmap {
namespace {

bool IsSurface(const BlockEntry& entry, int linear, double voxel_size_m) {
  return entry.tsdf != nullptr && entry.Shows(linear) &&
         std::abs(entry.tsdf->distance_m[static_cast<std::size_t>(linear)]) <= voxel_size_m / 2;
}

/// Whether a voxel in the 3^3 neighbourhood of `v` is at the surface.
bool HasSurfaceBeside(const Submap& submap, VoxelIndex v) {
  for (int n = 0; n < 27; ++n) {
    const VoxelIndex beside{v.x + n % 3 - 1, v.y + n / 3 % 3 - 1, v.z + n / 9 - 1};
    const BlockEntry* entry = submap.blocks().Find(BlockOf(beside));
    if (entry != nullptr && IsSurface(*entry, LinearIndex(beside), submap.info().voxel_size_m)) return true;
  }
  return false;
}

/// Whether the submap has the block or one of its 26 neighbours.
bool HasBlockBeside(const Submap& submap, BlockIndex index) {
  for (int n = 0; n < 27; ++n) {
    if (submap.blocks().Find({index.x + n % 3 - 1, index.y + n / 3 % 3 - 1, index.z + n / 9 - 1}) != nullptr)
      return true;
  }
  return false;
}

}  // namespace

bool HasSurfaceVoxels(const Submap& submap, std::int64_t least) {
  std::int64_t count = 0;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      count += IsSurface(entry, linear, submap.info().voxel_size_m);
      if (count >= least) return true;
    }
  }
  return least <= 0;
}

bool SurfacesTouch(const Submap& a, const Submap& b) {
  const bool b_is_smaller = b.blocks().size() < a.blocks().size();
  const Submap& small = b_is_smaller ? b : a;
  const Submap& large = b_is_smaller ? a : b;
  for (const BlockEntry& entry : small.blocks().entries()) {
    if (!HasBlockBeside(large, entry.index)) continue;
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      if (!IsSurface(entry, linear, small.info().voxel_size_m)) continue;
      if (HasSurfaceBeside(large, VoxelIn(entry.index, linear))) return true;
    }
  }
  return false;
}

}  // namespace dhpmap

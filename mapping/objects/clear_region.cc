// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/clear_region.h"

#include <cmath>

#include "mapping/evidence/submap_labels.h"
#include "mapping/objects/voxel_transfer.h"

namespace dhpmap {
namespace {

struct Found {
  VoxelSet voxels;
  std::int64_t num_voxels = 0;
};

Found FindIn(const Region& region, const Submap& submap) {
  Found found;
  const SubmapInfo& info = submap.info();
  const double side_m = kBlockSide * info.voxel_size_m;
  const double block_radius_m = 0.5 * std::sqrt(3.0) * side_m;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    const Eigen::Vector3d center_m = BlockCorner(entry.index, info.voxel_size_m).array() + 0.5 * side_m;
    if (!Touches(region, info.T_map_submap * center_m, block_radius_m)) continue;
    std::bitset<kBlockVoxels> of_block;
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!HasVoxel(entry, i)) continue;
      const Eigen::Vector3d p_m = VoxelCentre(VoxelIn(entry.index, i), info.voxel_size_m);
      of_block[static_cast<std::size_t>(i)] = Contains(region, info.T_map_submap * p_m);
    }
    if (of_block.none()) continue;
    found.num_voxels += static_cast<std::int64_t>(of_block.count());
    found.voxels.emplace(entry.index, of_block);
  }
  return found;
}

}  // namespace

ClearedRegion ClearRegion(const Region& region, const std::function<bool(const SubmapInfo&)>& is_meant, Map& map) {
  std::vector<std::pair<SubmapId, Found>> found;
  for (const auto& submap : map.submaps()) {
    const BoundingSphere sphere = submap->BoundingSphereInMap();
    if (!is_meant(submap->info()) || !Touches(region, sphere.center_m, sphere.radius_m)) continue;
    Found in_region = FindIn(region, *submap);
    if (in_region.num_voxels > 0) found.emplace_back(submap->id(), std::move(in_region));
  }
  ClearedRegion cleared;
  for (const auto& [id, in_region] : found) {
    cleared.num_voxels += in_region.num_voxels;
    cleared.changed.push_back(id);
    Submap& submap = *map.FindMutable(id);
    EraseVoxels(in_region.voxels, submap);
    submap.PruneBlocks();
    submap.UpdateBoundingSphere();
    if (submap.blocks().empty() && map.Remove(id)) cleared.removed.push_back(id);
    else RecomputeSubmapLabels(submap);
  }
  return cleared;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_stats.h"

namespace dhpmap {
namespace {

void AddBlocks(const Submap& submap, bool with_voxels, MapStats& stats) {
  for (const BlockEntry& entry : submap.blocks().entries()) {
    if (entry.labels) ++stats.num_label_blocks;
    if (!entry.tsdf) continue;
    ++stats.num_tsdf_blocks;
    if (with_voxels) stats.num_observed_voxels += entry.tsdf->NumObservedVoxels();
  }
}

}  // namespace

MapStats ComputeStats(const MapSnapshot& snapshot, bool with_voxels) {
  MapStats stats;
  stats.memory_bytes =
      static_cast<std::int64_t>(snapshot.free_space()->MemoryBytes() + snapshot.vacated()->MemoryBytes());
  for (const auto& submap : snapshot.submaps()) {
    const bool is_thing = submap->info().panoptic == Panoptic::kThing;
    ++stats.num_submaps;
    stats.num_things += is_thing ? 1 : 0;
    stats.num_stuff += submap->info().panoptic == Panoptic::kStuff ? 1 : 0;
    stats.num_active += is_thing && submap->info().activity == Activity::kActive ? 1 : 0;
    stats.memory_bytes += static_cast<std::int64_t>(submap->MemoryBytes());
    AddBlocks(*submap, with_voxels, stats);
  }
  return stats;
}

Result<MapReport> ReportOf(MapRegistry& registry, const std::string& map) {
  DHPMAP_ASSIGN_OR_RETURN(const auto view, registry.ViewOf(map));
  const MapSnapshot& snapshot = view->snapshot();
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t disk_bytes, registry.DiskBytes(map));
  return MapReport{.revision = snapshot.revision(),
                   .num_frames = snapshot.info().num_frames,
                   .stats = ComputeStats(snapshot, /*with_voxels=*/true),
                   .disk_bytes = disk_bytes};
}

}  // namespace dhpmap

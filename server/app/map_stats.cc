// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/map_stats.h"

#include <bit>

#include "mapping/map/scanned_tile.h"

namespace dhpmap {
namespace {

void AddBlocks(const Submap& submap, bool with_voxels, MapStats& stats) {
  for (const TileEntry& tile : submap.blocks().tiles()) {
    const std::int64_t num_labels = std::popcount(tile.tile->CellsWith(BlockLayer::kLabels));
    const std::int64_t num_tsdf = std::popcount(tile.tile->CellsWith(BlockLayer::kTsdf));
    stats.num_label_blocks += num_labels;
    stats.num_tsdf_blocks += num_tsdf;
    if (tile.tile->IsRead()) {
      stats.num_label_blocks_in_memory += num_labels;
      stats.num_tsdf_blocks_in_memory += num_tsdf;
    }
    if (!with_voxels) continue;
    for (const ScannedTile scanned(*tile.tile); const BlockEntry& entry : scanned.entries()) {
      stats.num_observed_voxels += entry.tsdf ? entry.tsdf->NumObservedVoxels() : 0;
    }
  }
}

}  // namespace

MapStats ComputeStats(const MapSnapshot& snapshot, bool with_voxels) {
  MapStats stats;
  stats.memory_bytes =
      static_cast<std::int64_t>(snapshot.free_space()->MemoryBytes() + snapshot.noted_vacated()->MemoryBytes());
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

Result<MapReport> ReportOf(MapRegistry& registry, const MapView& view) {
  const MapSnapshot& snapshot = view.snapshot();
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t disk_bytes, registry.DiskBytes(snapshot.info().name));
  return MapReport{.revision = snapshot.revision(),
                   .num_frames = snapshot.info().num_frames,
                   .stats = ComputeStats(snapshot, /*with_voxels=*/true),
                   .disk_bytes = disk_bytes};
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/map_stats.h"

#include <atomic>
#include <bit>
#include <vector>

#include "mapping/voxels/block_tile.h"

namespace dhpmap {
namespace {

void AddBlocks(const Submap& submap, MapStats& stats) {
  for (const TileEntry& tile : submap.blocks().tiles()) {
    const std::int64_t num_labels = std::popcount(tile.tile->CellsWith(BlockLayer::kLabels));
    const std::int64_t num_tsdf = std::popcount(tile.tile->CellsWith(BlockLayer::kTsdf));
    stats.num_label_blocks += num_labels;
    stats.num_tsdf_blocks += num_tsdf;
    stats.num_tsdf_blocks_in_memory += tile.tile->IsRead() ? num_tsdf : 0;
    stats.label_plane_bytes_in_memory += static_cast<std::int64_t>(tile.tile->LabelPlaneBytes());
  }
}

std::int64_t NumObservedVoxels(const MapSnapshot& snapshot, const Spread& spread, const std::stop_token& stop) {
  std::vector<const BlockTile*> tiles;
  for (const auto& submap : snapshot.submaps()) {
    for (const TileEntry& entry : submap->blocks().tiles()) tiles.push_back(entry.tile.get());
  }
  std::atomic<std::int64_t> num_voxels = 0;
  InParts(tiles.size(), spread, stop, [&](std::size_t i) {
    std::int64_t of_tile = 0;
    for (const ScannedTile scanned(*tiles[i]); const BlockEntry& entry : scanned.entries()) {
      of_tile += entry.tsdf ? entry.tsdf->NumObservedVoxels() : 0;
    }
    num_voxels.fetch_add(of_tile, std::memory_order_relaxed);
  });
  return num_voxels.load();
}

}  // namespace

MapStats ComputeStats(const MapSnapshot& snapshot, bool with_voxels, const Spread& spread,
                      const std::stop_token& stop) {
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
    AddBlocks(*submap, stats);
  }
  if (with_voxels) stats.num_observed_voxels = NumObservedVoxels(snapshot, spread, stop);
  return stats;
}

Result<MapReport> ReportOf(MapRegistry& registry, const MapView& view, const Spread& spread,
                           const std::stop_token& stop) {
  const MapSnapshot& snapshot = view.snapshot();
  DHPMAP_ASSIGN_OR_RETURN(const std::int64_t disk_bytes, registry.DiskBytes(snapshot.info().name));
  const MapStats stats = ComputeStats(snapshot, /*with_voxels=*/true, spread, stop);
  if (stop.stop_requested()) return Cancelled("nobody waits for the statistics any longer");
  return MapReport{.revision = snapshot.revision(),
                   .num_frames = snapshot.info().num_frames,
                   .stats = stats,
                   .disk_bytes = disk_bytes};
}

}  // namespace dhpmap

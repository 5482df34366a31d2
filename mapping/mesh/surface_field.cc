// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/surface_field.h"

#include <algorithm>
#include <array>
#include <memory>

#include "mapping/mesh/mesh_sources.h"
#include "mapping/submap/voxel_answer.h"
#include "mapping/voxels/voxel_average.h"

namespace dhpmap {
namespace {

/// The blocks of all submaps, sorted by index, then by submap.
MeshingVector<BlockHolder> SortedBlocks(std::span<const Submap* const> submaps, const IndexMap<BlockIndex>* only) {
  MeshingVector<BlockHolder> sorted;
  for (const Submap* submap : submaps) {
    for (const TileEntry& tile : submap->blocks().tiles()) {
      // Blocks on disk that are not needed stay there.
      if (only != nullptr && NumBlocksIn(tile, *only) == 0) continue;
      for (const BlockEntry& entry : tile.tile->entries()) {
        if (entry.tsdf == nullptr) continue;
        if (only != nullptr && only->Find(entry.index) == IndexMap<BlockIndex>::kNone) continue;
        sorted.push_back({submap, &entry});
      }
    }
  }
  std::sort(sorted.begin(), sorted.end(), [](const BlockHolder& a, const BlockHolder& b) {
    return a.block->index != b.block->index ? a.block->index < b.block->index : a.submap->id() < b.submap->id();
  });
  return sorted;
}

/// Averages the holders' data at a voxel, weighted as in fusion (MergedAverage). Returns the holder that answers for
/// it.
std::uint16_t AverageVoxel(std::span<const BlockHolder> holders, int linear, TsdfBlock& average) {
  const auto i = static_cast<std::size_t>(linear);
  MergedAverage<double> merged;
  VoxelSupport best;
  std::uint16_t answers = 0;
  bool is_first = true;
  for (std::uint16_t h = 0; h < holders.size(); ++h) {
    const TsdfBlock& tsdf = *holders[h].block->tsdf;
    if (!holders[h].block->Shows(linear)) continue;
    merged.Add(tsdf, i);
    const VoxelSupport support = SupportOfVoxel(*holders[h].submap, *holders[h].block, linear);
    if (is_first || support > best) {
      best = support;
      answers = h;
    }
    is_first = false;
  }
  merged.Store(average, i);
  return answers;
}

}  // namespace

SurfaceField::SurfaceField(std::span<const Submap* const> submaps, ThreadPool& pool, const FieldScope& scope)
    : T_map_field_(scope.is_in_own_frame ? Transform::Identity() : submaps[0]->info().T_map_submap),
      voxel_size_m_(submaps[0]->info().voxel_size_m) {
  for (const BlockHolder& holder : SortedBlocks(submaps, scope.blocks)) {
    const BlockIndex index = holder.block->index;
    if (blocks_.empty() || blocks_.back().index != index) {
      numbers_.Set(index, static_cast<std::uint32_t>(blocks_.size()));
      blocks_.push_back({.index = index, .tsdf = holder.block->tsdf, .labels = nullptr});
      holders_.emplace_back();
    }
    holders_.back().all.push_back(holder);
  }
  numbers_bytes_.Set(numbers_.MemoryBytes());
  pool.ParallelFor(blocks_.size(), [&](std::size_t i) {
    const MeshingVector<BlockHolder>& all = holders_[i].all;
    if (all.size() > 1 || all[0].block->gone != nullptr) Merge(holders_[i], blocks_[i]);
  });
}

void SurfaceField::Merge(Holders& holders, BlockEntry& merged) {
  auto tsdf = std::allocate_shared<TsdfBlock>(CountedAllocator<TsdfBlock, MemoryKind::kMeshing>());
  holders.of_voxel.assign(kBlockVoxels, 0);
  std::array<bool, kBlockVoxels> is_held{}, is_shared{};
  for (std::uint16_t h = 0; h < holders.all.size(); ++h) {
    const TsdfBlock& own = *holders.all[h].block->tsdf;
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      if (!holders.all[h].block->Shows(static_cast<int>(i))) continue;
      is_shared[i] = is_held[i];
      if (is_held[i]) continue;
      is_held[i] = true;
      tsdf->distance_m[i] = own.distance_m[i];
      tsdf->weight[i] = own.weight[i];
      tsdf->color[i] = own.color[i];
      holders.of_voxel[i] = h;
    }
  }
  for (std::size_t i = 0; i < kBlockVoxels; ++i) {
    if (is_shared[i]) holders.of_voxel[i] = AverageVoxel(holders.all, static_cast<int>(i), *tsdf);
  }
  merged.tsdf = std::move(tsdf);
}

}  // namespace dhpmap

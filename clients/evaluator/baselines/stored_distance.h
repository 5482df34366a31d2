// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "mapping/submap/submap.h"

namespace dhpmap::evaluator {

/// The distance stored at a voxel of a map on the map frame's grid; nothing if the voxel was not observed.
inline std::optional<float> DistanceAt(const Submap& map, VoxelIndex voxel) {
  const BlockEntry* block = map.blocks().Find(BlockOf(voxel));
  const int linear = LinearIndex(voxel);
  if (block == nullptr || block->tsdf == nullptr || !block->tsdf->IsObserved(linear)) return std::nullopt;
  return block->tsdf->distance_m[static_cast<std::size_t>(linear)];
}

}  // namespace dhpmap::evaluator

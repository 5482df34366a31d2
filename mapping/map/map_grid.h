// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map_config.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// Whether the submap's voxels are those of the map's own grid, so that the same index is the same place: it was not
/// moved and has the map's voxel size.
inline bool IsOnMapGrid(const SubmapInfo& info, const MapConfig& config) {
  return info.voxel_size_m == config.voxel_size_m && IsIdentity(info.T_map_submap);
}

/// Whether the submap is one of those that share the map's grid so that each position is held once: it lies on that
/// grid because it was seen there. What somebody has moved or cloned stands outside even where it lies on the grid,
/// beside its original: it shares positions with others, and refinement neither reads nor writes it. Pure, thread-safe.
inline bool IsExclusive(const SubmapInfo& info, const MapConfig& config) {
  return !info.is_placed && IsOnMapGrid(info, config);
}

}  // namespace dhpmap

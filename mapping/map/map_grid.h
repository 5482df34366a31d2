// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map_config.h"
#include "mapping/submap/submap.h"

namespace dhpmap {

/// Whether the submap is aligned with the map's own grid, so that equal indices are equal places: it was not moved and
/// has the map's voxel size.
inline bool IsOnMapGrid(const SubmapInfo& info, const MapConfig& config) {
  return info.voxel_size_m == config.voxel_size_m && IsIdentity(info.T_map_submap);
}

/// Whether the submap takes part in exclusive assignment of positions: it lies on the map's grid because it was seen
/// there. An object that an edit moved or cloned does not, even if it is aligned: it may overlap others, and refinement
/// neither reads nor writes it. Pure, thread-safe.
inline bool IsExclusive(const SubmapInfo& info, const MapConfig& config) {
  return !info.is_placed && IsOnMapGrid(info, config);
}

}  // namespace dhpmap

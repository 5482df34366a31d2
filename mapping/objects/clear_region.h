// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mapping/map/map.h"
#include "mapping/map/region.h"

namespace dhpmap {

struct ClearedRegion {
  std::int64_t num_voxels = 0;
  std::vector<SubmapId> changed;  ///< by ascending id; includes the removed ones:
  std::vector<SubmapId> removed;
};

/// Removes the observations within a region, by voxel centres, from the submaps that `is_meant` accepts. Submaps left
/// empty are removed, except the unknown submap. Free space stays free; the rest becomes unknown. Time is linear in the
/// blocks of the submaps that the region touches.
ClearedRegion ClearRegion(const Region& region, const std::function<bool(const SubmapInfo&)>& is_meant, Map& map);

}  // namespace dhpmap

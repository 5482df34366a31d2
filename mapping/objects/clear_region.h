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
  std::vector<SubmapId> changed;  ///< by ascending id; of these are gone:
  std::vector<SubmapId> removed;
};

/// Takes everything that was observed within a region, by the voxels' centres, from the submaps that `is_meant`. Those
/// of which nothing is left are removed, but not the unknown submap. What sensors have looked through stays free; the
/// rest is unknown afterwards. Cost: the blocks of submaps that the region touches.
ClearedRegion ClearRegion(const Region& region, const std::function<bool(const SubmapInfo&)>& is_meant, Map& map);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/map/map.h"

namespace dhpmap {

/// What a map holds and what it takes in memory.
struct MapStats {
  std::int64_t num_submaps = 0;  ///< the unknown submap included
  std::int64_t num_things = 0;
  std::int64_t num_stuff = 0;
  std::int64_t num_active = 0;  ///< of the things
  std::int64_t num_tsdf_blocks = 0;
  std::int64_t num_label_blocks = 0;
  std::int64_t num_observed_voxels = 0;
  std::int64_t memory_bytes = 0;
};

/// Visits every submap; if `with_voxels` also every voxel, else num_observed_voxels stays 0. Blocks that clones share
/// count once for each.
MapStats ComputeStats(const MapSnapshot& snapshot, bool with_voxels);

}  // namespace dhpmap

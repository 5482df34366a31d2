// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stop_token>
#include <string>

#include "mapping/base/result.h"
#include "mapping/base/spread.h"
#include "mapping/map/map.h"
#include "server/app/maps/map_registry.h"

namespace dhpmap {

/// Content of a map and its memory.
struct MapStats {
  std::int64_t num_submaps = 0;  ///< the unknown submap included
  std::int64_t num_things = 0;
  std::int64_t num_stuff = 0;
  std::int64_t num_active = 0;  ///< of things
  std::int64_t num_tsdf_blocks = 0;
  std::int64_t num_label_blocks = 0;
  std::int64_t num_observed_voxels = 0;
  // Blocks in memory, without evicted ones (see TilePage).
  std::int64_t num_tsdf_blocks_in_memory = 0;
  std::int64_t label_plane_bytes_in_memory = 0;  ///< see LabelBlock::CountedBytes
  std::int64_t memory_bytes = 0;
};

/// Visits every block; with `with_voxels` also every voxel, else num_observed_voxels stays 0. Blocks that clones share
/// count for each. Invalid after a `stop` request. Throws StatusError.
MapStats ComputeStats(const MapSnapshot& snapshot, bool with_voxels, const Spread& spread = InPlace,
                      const std::stop_token& stop = {});

/// Content and cost of a map.
struct MapReport {
  std::int64_t revision = 0;
  std::int64_t num_frames = 0;
  MapStats stats;
  std::int64_t disk_bytes = 0;  ///< encoded blocks in the store, at present
};

/// For a state of a map; NOT_FOUND if the map is gone, CANCELLED after a `stop`. Visits every voxel. Throws
/// StatusError.
Result<MapReport> ReportOf(MapRegistry& registry, const MapView& view, const Spread& spread = InPlace,
                           const std::stop_token& stop = {});

}  // namespace dhpmap

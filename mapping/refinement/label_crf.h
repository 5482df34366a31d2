// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "mapping/base/ids.h"
#include "mapping/base/thread_pool.h"
#include "mapping/evidence/refinement_region.h"
#include "mapping/map/map.h"

namespace dhpmap {

struct LabelCrfReport {
  std::int64_t num_voxels = 0;             ///< that took part
  std::int64_t num_changed_classes = 0;    ///< voxels that went to a submap of another class
  std::int64_t num_changed_instances = 0;  ///< voxels that went to another submap
  int num_tiles = 0;                       ///< parts that were solved one by one
};

/// Blocks beyond a tile whose labels reach into it: what lies farther than 1.5 standard deviations of the wider kernel
/// has little to say against what is near. Wider rims changed nothing on a house and cost a third more.
int RimOfLabels(const MapConfig& config);

/// CRF (paper II-E) over the labelled voxels of the submaps `ids`, which label management has made exclusive: which
/// submap each belongs to, and with it its class. It goes by what voxels have seen, and changes nothing of that: one
/// that belongs elsewhere moves there with all its counts, and is marked where that is against what it has seen most
/// (LabelBlock::IsConcluded). What an earlier run has concluded has no say. Does not depend on the number of threads.
/// With `region`, the voxels of its cubes: what becomes of them is the same as if all of the map were solved at once.
LabelCrfReport RefineLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool,
                            const RefinementRegion* region = nullptr, const std::function<bool()>& is_cancelled = {});

}  // namespace dhpmap

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
  std::int64_t num_voxels = 0;             ///< in the random field
  std::int64_t num_changed_classes = 0;    ///< voxels that moved to a submap of another class
  std::int64_t num_changed_instances = 0;  ///< voxels that moved to another submap
  int num_tiles = 0;                       ///< parts that were solved separately
};

/// Width in blocks of the rim around a tile whose labels influence the tile: 1.5 standard deviations of the wider
/// kernel. Wider rims changed nothing on a house and cost a third more.
int RimOfLabels(const MapConfig& config);

/// Runs the CRF (paper II-E) over the labelled voxels of the submaps `ids`, which label management has made exclusive.
/// It decides the submap of each voxel, and with it the class. The evidence are the voxels' counts, which it never
/// changes: a voxel that changes its submap keeps all counts, and is marked if the new submap is not its most frequent
/// label (LabelBlock::IsConcluded). Conclusions of earlier runs do not count. The result does not depend on the number
/// of threads. With `region`, only the voxels of its cubes change, with the same result as in a run over the whole map.
LabelCrfReport RefineLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool,
                            const RefinementRegion* region = nullptr, const std::function<bool()>& is_cancelled = {});

}  // namespace dhpmap

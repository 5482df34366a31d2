// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/base/ids.h"
#include "mapping/base/thread_pool.h"
#include "mapping/evidence/refinement_region.h"
#include "mapping/map/map.h"

namespace dhpmap {

struct ManagementReport {
  std::int64_t num_shared_voxels = 0;  ///< positions with more than one holder
  std::int64_t num_moved_voxels = 0;   ///< voxels that moved from one submap to another
  int num_removed_submaps = 0;         ///< submaps left empty
  int num_skipped_submaps = 0;         ///< moved or cloned by an edit, or of another voxel size: not merged
};

/// Inter-submap label management (paper II-D): afterwards each voxel position of the map's grid belongs to at most one
/// of the submaps `ids` that share it (IsExclusive), that of the winning instance.
///   - The voxels of several submaps at a position are merged: weighted average of distance and colour, sums of weights
///     and counts. The unknown submap may be among `ids`; without counts, it only keeps positions that no other holds.
///   - The instance of `ids` with the most observations wins (ties: the smaller id). Without any such count, the voxel
///     goes to the holder of the smallest id, the unknown submap last.
///   - A voxel held by conclusion (LabelBlock::IsConcluded) stays if it has only one holder. With several, it was
///     observed again: counts decide, and the conclusion is dropped.
///   - Empty blocks and submaps are removed; spheres, classes and confidences of changed ones are recomputed.
///
/// Sums of counts and weights are conserved (weights are not capped here). The operation is idempotent and independent
/// of the number of threads. Ids that are not in the map are ignored. With `region`, only blocks within `rim` of its
/// cubes are processed.
ManagementReport ManageLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool,
                              const RefinementRegion* region = nullptr, int rim = 0);

}  // namespace dhpmap

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
  std::int64_t num_shared_voxels = 0;  ///< positions that more than one submap held
  std::int64_t num_moved_voxels = 0;   ///< voxels that left a submap for another
  int num_removed_submaps = 0;         ///< that held nothing any more
  int num_skipped_submaps = 0;         ///< moved or cloned by somebody, or of another voxel size: never merged
};

/// Inter-submap label management (paper II-D): afterwards each voxel position of the map's grid is held by at most one
/// of the submaps `ids` that share it (IsExclusive), the one of its winning instance.
///   - What several submaps hold at a position is merged: weighted average of distance and colour, weights and counts
///     added. The unknown submap may be among `ids`; it has no counts, so it only keeps what nobody else holds.
///   - The winner is the instance with the most observations among `ids`; ties go to the smaller id. Where no count
///     names one of them, the voxel stays with the smallest id that holds it, the unknown submap last.
///   - A voxel that one of them alone holds by conclusion (LabelBlock::IsConcluded) stays. Where others hold it, too,
///   it
///     was seen anew: what was seen decides, and what was concluded of it is forgotten.
///   - Blocks and submaps left empty are removed, spheres, classes and confidences of what changed recomputed.
/// Sums of counts and weights are conserved (weights are not capped here). Running it again changes nothing. The result
/// does not depend on the number of threads. Ids that are not in the map are ignored.
/// With `region`, what lies in its cubes and within `rim` blocks of them.
ManagementReport ManageLabels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool,
                              const RefinementRegion* region = nullptr, int rim = 0);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/base/ids.h"
#include "mapping/base/refinement_scratch.h"
#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// A conclusion of refinement: the submap that holds a voxel from now on. `from`, the present holder, may equal `to`.
struct Handover {
  BlockIndex block;
  std::uint16_t linear;
  SubmapId from, to;
  bool is_concluded;  ///< against the voxel's counts (LabelBlock::IsConcluded)
};

/// Moves voxels with all their data: counts, weights and averages, so no observation is lost or counted twice. At
/// positions that `to` holds already, they are merged as in label management. If positions are not exclusive, only the
/// handover of the smallest `from` is done for a voxel. All submaps must exist and hold the voxels; `to` is never the
/// unknown submap. Recomputes spheres and totals. Independent of the order of the list and of the number of threads.
void HandOver(ScratchVector<Handover> handovers, Map& map, ThreadPool& pool);

/// Drops the conclusions of refinement in the submaps `ids`: each voxel returns to the submap among them with the most
/// counts (KnownInstances::MostSeen). Returns how many conclusions were dropped.
std::int64_t ForgetConclusions(std::span<const SubmapId> ids, Map& map, ThreadPool& pool);

}  // namespace dhpmap

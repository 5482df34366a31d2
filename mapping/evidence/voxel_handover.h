// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/base/ids.h"
#include "mapping/base/refinement_scratch.h"
#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// What refinement concludes of a voxel: which submap holds it from now on. `from`, which holds it, may be `to`.
struct Handover {
  BlockIndex block;
  std::uint16_t linear;
  SubmapId from, to;
  bool is_concluded;  ///< against what the voxel has seen most (LabelBlock::IsConcluded)
};

/// Moves voxels, all that they have seen with them: counts, weights and averages go along as they are, so nothing that
/// was observed is lost or counted anew. Where `to` holds something at the position it is merged as in label
/// management. Where positions are not exclusive, one of the handovers of a voxel is done, that of the smallest `from`.
/// All submaps are in the map and hold what they hand over; nothing goes to the unknown one. Spheres and
/// totals of what changed are recomputed. The result does not depend on the order of the list or the number of threads.
void HandOver(ScratchVector<Handover> handovers, Map& map, ThreadPool& pool);

/// Throws away what refinement has concluded of the submaps `ids`: each voxel goes back to the submap among them that
/// it has seen most (see KnownInstances::MostSeen). Returns how many there were.
std::int64_t ForgetConclusions(std::span<const SubmapId> ids, Map& map, ThreadPool& pool);

}  // namespace dhpmap

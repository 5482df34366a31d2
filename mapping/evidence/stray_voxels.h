// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/base/ids.h"
#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// An object is one cohesive thing (paper II-E): islands of a few voxels that lie apart from it, left behind by waving
/// outlines on the wall behind, go to the submap that holds most of the voxels around them. They are a percent of its
/// voxels and double its bounding box. An island is stray if it has at most 16 voxels and less than a tenth of the
/// largest one's. Only things among `ids`, which label management has made exclusive, lose voxels; what nobody else
/// touches stays. The counts of the old and new instance are exchanged, so all sums are conserved. Does not depend on
/// the number of threads. Returns how many voxels changed hands.
std::int64_t AbsorbStrayVoxels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "mapping/base/ids.h"
#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// Objects are cohesive (paper II-E): islands of a few voxels apart from an object, left on the wall behind by
/// jittering outlines, go to the submap that holds most of the voxels around them. They are about 1 % of the voxels but
/// double the bounding box. An island is stray with at most 16 voxels and less than a tenth of the largest part. Only
/// things among `ids`, made exclusive by label management, lose voxels; voxels without neighbours of another submap
/// stay. Counts of the old and the new instance are exchanged, so all sums are conserved. Independent of the number of
/// threads. Returns how many voxels moved.
std::int64_t AbsorbStrayVoxels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool);

}  // namespace dhpmap

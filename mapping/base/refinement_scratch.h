// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/memory_count.h"

namespace dhpmap {

/// Working memory of a refinement that grows with its voxels or blocks, counted as MemoryKind::kRefinement. Blocks that
/// a refinement writes belong to the map and count there.
template <typename T>
using ScratchAllocator = CountedAllocator<T, MemoryKind::kRefinement>;
template <typename T>
using ScratchVector = CountedVector<T, MemoryKind::kRefinement>;

}  // namespace dhpmap

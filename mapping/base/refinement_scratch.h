// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/memory_count.h"

namespace dhpmap {

/// For a refinement's working memory that grows with the voxels or blocks it works on: counted as
/// MemoryKind::kRefinement from its allocation on. Blocks that a refinement writes are the map's, and counted there.
template <typename T>
using ScratchAllocator = CountedAllocator<T, MemoryKind::kRefinement>;
template <typename T>
using ScratchVector = CountedVector<T, MemoryKind::kRefinement>;

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/voxels/tsdf_block.h"

#include <algorithm>

#include "mapping/base/free_memory.h"
#include "mapping/base/memory_count.h"

namespace dhpmap {
namespace {

/// The allocator rounds up by 9 %.
std::size_t HeapBytesOfOne() {
  static const std::size_t bytes = HeapBytesFor(sizeof(TsdfBlock));
  return bytes;
}

}  // namespace

void* TsdfBlock::operator new(std::size_t bytes) { return NewCounted(MemoryKind::kBlocks, bytes, HeapBytesOfOne()); }

void TsdfBlock::operator delete(void* block, std::size_t /*bytes*/) {
  DeleteCounted(MemoryKind::kBlocks, block, HeapBytesOfOne());
}

bool TsdfBlock::HasObservedVoxel() const {
  return std::any_of(weight.begin(), weight.end(), [](float w) { return w >= kMinObservedWeight; });
}

int TsdfBlock::NumObservedVoxels() const {
  return static_cast<int>(std::count_if(weight.begin(), weight.end(), [](float w) { return w >= kMinObservedWeight; }));
}

}  // namespace dhpmap

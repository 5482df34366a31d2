// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "mapping/base/grid.h"
#include "mapping/base/memory_count.h"

namespace dhpmap {

/// One value per voxel of a block, initially zero, in its own allocation. If that is a whole page, the allocator wastes
/// nothing and frees the page with the block, whatever happens to neighbouring allocations. Indexed by LinearIndex.
/// Copies are deep. Counted as MemoryKind::kBlocks. Thread-compatible.
template <typename T>
class VoxelPlane {
 public:
  VoxelPlane() : values_(std::make_unique<Values>()) {}
  /// A plane without values, as after a move.
  static VoxelPlane None() { return VoxelPlane(nullptr); }
  VoxelPlane(const VoxelPlane& other) : values_(other ? std::make_unique<Values>(*other.values_) : nullptr) {}
  VoxelPlane& operator=(const VoxelPlane& other) { return *this = VoxelPlane(other); }
  VoxelPlane(VoxelPlane&& other) noexcept = default;
  VoxelPlane& operator=(VoxelPlane&& other) noexcept = default;
  ~VoxelPlane() = default;

  /// Whether it has values.
  explicit operator bool() const { return values_ != nullptr; }
  T& operator[](std::size_t linear) { return values_->all[linear]; }
  const T& operator[](std::size_t linear) const { return values_->all[linear]; }

  static constexpr std::size_t kBytes = sizeof(std::array<T, kBlockVoxels>);  ///< size of the allocation

 private:
  struct Values {
    std::array<T, kBlockVoxels> all{};
    static void* operator new(std::size_t bytes) { return NewCounted(MemoryKind::kBlocks, bytes, bytes); }
    static void operator delete(void* values, std::size_t bytes) { DeleteCounted(MemoryKind::kBlocks, values, bytes); }
  };
  explicit VoxelPlane(std::nullptr_t) {}

  std::unique_ptr<Values> values_;
};

}  // namespace dhpmap

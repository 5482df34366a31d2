// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>

#include "mapping/base/grid.h"

namespace dhpmap {

/// One value a voxel of a block, zero at first, in an allocation of its own: where that is a whole page, the allocator
/// rounds nothing up and gives the page back with the block, whatever its neighbours do. Indexed by LinearIndex. Copies
/// are deep; it is never without its values, so there is no moving. Thread-compatible.
template <typename T>
class VoxelPlane {
 public:
  VoxelPlane() : values_(std::make_unique<Values>()) {}
  VoxelPlane(const VoxelPlane& other) : values_(std::make_unique<Values>(*other.values_)) {}
  VoxelPlane& operator=(const VoxelPlane& other) {
    *values_ = *other.values_;
    return *this;
  }
  ~VoxelPlane() = default;

  T& operator[](std::size_t linear) { return (*values_)[linear]; }
  const T& operator[](std::size_t linear) const { return (*values_)[linear]; }

  static constexpr std::size_t kBytes = sizeof(std::array<T, kBlockVoxels>);  ///< of the allocation

 private:
  using Values = std::array<T, kBlockVoxels>;
  std::unique_ptr<Values> values_;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/base/grid.h"
#include "mapping/space/cell.h"
#include "mapping/voxels/tsdf_block.h"

namespace dhpmap {

/// The voxels of a block that claim a surface within `most_m` of them: 1 or 0 per voxel, by LinearIndex.
class SurfaceClaims {
 public:
  /// Reads the whole block once, vectorised; the result is the same with every instruction set.
  void Read(const TsdfBlock& block, float most_m);

  /// Prefetches a block that will be read soon.
  static void Prefetch(const TsdfBlock& block) {
    constexpr std::size_t kLineBytes = 64;
    const char* const first = reinterpret_cast<const char*>(block.distance_m.data());
    static_assert(offsetof(TsdfBlock, weight) == sizeof(block.distance_m), "both are read");
    for (std::size_t at = 0; at < 2 * sizeof(block.distance_m); at += kLineBytes) __builtin_prefetch(first + at);
  }

  /// Copies the claims of an octant (see ChildrenOf), x fastest. Returns whether there are any.
  bool Of(std::size_t octant, std::array<std::uint8_t, kOctantVoxels>& claims) const;
  [[nodiscard]] bool IsOne(int linear) const { return all_[static_cast<std::size_t>(linear)] != 0; }
  [[nodiscard]] int Count() const;

 private:
  alignas(64) std::array<std::uint8_t, kBlockVoxels> all_{};
};

}  // namespace dhpmap

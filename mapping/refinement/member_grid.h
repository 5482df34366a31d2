// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "mapping/base/index_map.h"
#include "mapping/base/refinement_scratch.h"
#include "mapping/refinement/tile_problem.h"

namespace dhpmap {

/// Finds a tile's members by their voxels. Immutable.
class MemberGrid {
 public:
  static constexpr std::uint32_t kNone = 0;

  /// 4 bytes a voxel of its places, 108 a place.
  explicit MemberGrid(const TileProblem& problem);

  /// One more than the number of the member at an offset of up to a block's side from a voxel, or kNone. Where
  /// positions are not exclusive, the last one stands for all.
  [[nodiscard]] std::uint32_t At(std::uint32_t place, int linear, int dx, int dy, int dz) const {
    const int x = (linear & 7) + dx, y = (linear >> 3 & 7) + dy, z = (linear >> 6) + dz;
    const int n = ((x >> 3) + 1) * 9 + ((y >> 3) + 1) * 3 + (z >> 3) + 1;  // in the order of VisitBlocksAround
    const std::uint32_t there = around_[place][static_cast<std::size_t>(n)];
    if (there == IndexMap<BlockIndex>::kNone) return kNone;
    return numbers_[there * std::size_t{kBlockVoxels} +
                    static_cast<std::size_t>((x & 7) | (y & 7) << 3 | (z & 7) << 6)];
  }

 private:
  ScratchVector<std::uint32_t> numbers_;  ///< by place, then voxel
  ScratchVector<std::array<std::uint32_t, 27>> around_;
};

}  // namespace dhpmap

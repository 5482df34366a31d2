// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <type_traits>

#include "mapping/mesh/surface_field.h"

namespace dhpmap {

/// A block with one voxel around it, as positions in an array of kVoxels: so that neighbours of a voxel can be read
/// without looking up blocks for each.
struct Halo {
  static constexpr int kSide = kBlockSide + 2;
  static constexpr int kVoxels = kSide * kSide * kSide;
  static constexpr int kStride[3] = {1, kSide, kSide* kSide};

  /// Voxel coordinates in the block, -1 to 8.
  [[nodiscard]] static constexpr int Position(int x, int y, int z) {
    return (x + 1) * kStride[0] + (y + 1) * kStride[1] + (z + 1) * kStride[2];
  }
  /// Inverse: counted from the first voxel of block (0, 0, 0).
  [[nodiscard]] static constexpr VoxelIndex VoxelAt(int position) {
    return {position % kSide - 1, position / kSide % kSide - 1, position / (kSide * kSide) - 1};
  }

  /// Blocks at offsets -1 to 1, x fastest; null where there is none.
  using Blocks = std::array<const BlockEntry*, 27>;
  [[nodiscard]] static Blocks FindBlocks(const SurfaceField& field, BlockIndex index) {
    Blocks blocks;
    for (int i = 0; i < 27; ++i) {
      blocks[static_cast<std::size_t>(i)] =
          field.Find({index.x + i % 3 - 1, index.y + i / 3 % 3 - 1, index.z + i / 9 - 1});
    }
    return blocks;
  }

  /// Calls visit(entry, linear, position, count) for each row along x: `count` (an integral constant) voxels of `entry`
  /// from `linear` on lie at `position` and after.
  template <typename Visitor>
  static void VisitRows(const Blocks& blocks, Visitor&& visit) {
    const auto first = [](int d) { return d < 0 ? -1 : d * kBlockSide; };
    const auto end = [](int d) { return d < 0 ? 0 : d * kBlockSide + (d > 0 ? 1 : kBlockSide); };
    for (int i = 0; i < 27; ++i) {
      const BlockEntry* entry = blocks[static_cast<std::size_t>(i)];
      if (entry == nullptr) continue;
      const int dx = i % 3 - 1, dy = i / 3 % 3 - 1, dz = i / 9 - 1;
      for (int z = first(dz); z < end(dz); ++z) {
        for (int y = first(dy); y < end(dy); ++y) {
          const int linear = LinearIndex({first(dx), y, z}), position = Position(first(dx), y, z);
          // Counts known to the compiler, which then needs no branches.
          if (dx == 0) visit(*entry, linear, position, std::integral_constant<int, kBlockSide>{});
          else visit(*entry, linear, position, std::integral_constant<int, 1>{});
        }
      }
    }
  }
};

}  // namespace dhpmap

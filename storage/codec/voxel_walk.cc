// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/voxel_walk.h"

#include <bit>

namespace dhpmap {
namespace {

/// Cells start one step from the border; cell 0 is border.
constexpr int GridCellOf(int linear) {
  const VoxelIndex v = VoxelIn({}, linear);
  return (v.x + 1) + (v.y + 1) * VoxelWalk::kGridSide + (v.z + 1) * VoxelWalk::kGridSide * VoxelWalk::kGridSide;
}

constexpr auto kCells = [] {
  std::array<std::uint16_t, kBlockVoxels> cells{};
  for (int i = 0; i < kBlockVoxels; ++i) cells[i] = static_cast<std::uint16_t>(GridCellOf(i));
  return cells;
}();

}  // namespace

VoxelWalk::VoxelWalk(const VoxelBits& mask) {
  std::array<std::uint8_t, kGridSize> masked{};
  std::uint16_t previous = 0;
  for (std::size_t byte = 0; byte < mask.size(); ++byte) {
    for (unsigned bits = mask[byte]; bits != 0; bits &= bits - 1) {
      const std::size_t i = 8 * byte + static_cast<std::size_t>(std::countr_zero(bits));
      const int cell = kCells[i];
      masked[cell] = 1;
      const bool x = masked[cell - kStepX], y = masked[cell - kStepY], z = masked[cell - kStepZ];
      const int near = x ? cell - kStepX : y ? cell - kStepY : z ? cell - kStepZ : previous;
      std::uint8_t faces = 0;
      if (x && y && masked[cell - kStepX - kStepY]) faces |= kXy;
      if (x && z && masked[cell - kStepX - kStepZ]) faces |= kXz;
      if (y && z && masked[cell - kStepY - kStepZ]) faces |= kYz;
      sites_[num_sites_++] = {static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(cell),
                              static_cast<std::uint16_t>(near), faces};
      previous = static_cast<std::uint16_t>(cell);
    }
  }
}

VoxelWalk::Grid& VoxelWalk::GridOfThread(Scratch which) {
  thread_local std::array<Grid, 2> grids{};
  return grids[static_cast<std::size_t>(which)];
}

}  // namespace dhpmap

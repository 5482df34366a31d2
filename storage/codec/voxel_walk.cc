// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/voxel_walk.h"

namespace dhpmap {
namespace {

constexpr int kStepX = 1;
constexpr int kStepY = VoxelWalk::kGridSide;
constexpr int kStepZ = VoxelWalk::kGridSide * VoxelWalk::kGridSide;
constexpr std::uint8_t kXy = 1, kXz = 2, kYz = 4;

/// Cells start one step from the border; cell 0 is border.
constexpr int CellOf(int linear) {
  const VoxelIndex v = VoxelIn({}, linear);
  return (v.x + 1) * kStepX + (v.y + 1) * kStepY + (v.z + 1) * kStepZ;
}

constexpr auto kCells = [] {
  std::array<std::uint16_t, kBlockVoxels> cells{};
  for (int i = 0; i < kBlockVoxels; ++i) cells[i] = static_cast<std::uint16_t>(CellOf(i));
  return cells;
}();

}  // namespace

VoxelWalk::VoxelWalk(const VoxelMask& mask) {
  std::array<std::uint8_t, kGridSize> masked{};
  std::uint16_t previous = 0;
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (!IsMasked(mask, i)) continue;
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

std::int32_t VoxelWalk::PredictSmooth(const Grid& grid, const Site& site) {
  if (site.faces == 0) return grid[site.near];
  const std::int32_t* value = grid.data() + site.cell;
  std::int32_t sum = 0, count = 0;
  if (site.faces & kXy) sum += value[-kStepX] + value[-kStepY] - value[-kStepX - kStepY], ++count;
  if (site.faces & kXz) sum += value[-kStepX] + value[-kStepZ] - value[-kStepX - kStepZ], ++count;
  if (site.faces & kYz) sum += value[-kStepY] + value[-kStepZ] - value[-kStepY - kStepZ], ++count;
  return sum / count;
}

}  // namespace dhpmap

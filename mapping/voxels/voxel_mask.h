// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "mapping/base/grid.h"

namespace dhpmap {

/// A set of voxels of a block: bit x + 8 y of word z.
using VoxelMask = std::array<std::uint64_t, kBlockSide>;

[[nodiscard]] constexpr bool IsIn(const VoxelMask& mask, int linear) {
  return (mask[static_cast<std::size_t>(linear >> 6)] >> (linear & 63) & 1u) != 0;
}

constexpr void SetIn(VoxelMask& mask, int linear, bool value) {
  std::uint64_t& word = mask[static_cast<std::size_t>(linear >> 6)];
  const std::uint64_t bit = std::uint64_t{1} << (linear & 63);
  word = value ? word | bit : word & ~bit;
}

[[nodiscard]] constexpr bool HasNone(const VoxelMask& mask) {
  std::uint64_t any = 0;
  for (const std::uint64_t word : mask) any |= word;
  return any == 0;
}

}  // namespace dhpmap

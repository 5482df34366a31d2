// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/free/free_tile.h"

namespace dhpmap {

/// What is known of the voxels of one block of a map's grid, so that nobody need ask every submap. A bit a voxel.
struct CellSight {
  FreeMask free{};                    ///< sensors have looked through it
  FreeMask observed{};                ///< in a submap that lies as mapped
  FreeMask front{};                   ///< and there in front of a surface
  std::vector<std::uint32_t> others;  ///< numbers of submaps that lie otherwise, and may hold something of it

  [[nodiscard]] static bool Has(const FreeMask& mask, int linear) {
    return (mask[static_cast<std::size_t>(linear >> 6)] >> (linear & 63) & 1u) != 0;
  }
};

}  // namespace dhpmap

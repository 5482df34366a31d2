// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/free/free_tile.h"

namespace dhpmap {

/// Observations of the voxels of one block of a map's grid, so that queries need not test every submap. One bit per
/// voxel.
struct CellSight {
  FreeMask free{};                    ///< sensors have looked through it
  FreeMask observed{};                ///< in a submap on the map's grid
  FreeMask front{};                   ///< and there in front of a surface
  std::vector<std::uint32_t> others;  ///< numbers of submaps off the grid that may have voxels in the block

  [[nodiscard]] static bool Has(const FreeMask& mask, int linear) {
    return (mask[static_cast<std::size_t>(linear >> 6)] >> (linear & 63) & 1u) != 0;
  }
};

}  // namespace dhpmap

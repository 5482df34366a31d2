// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mapping/voxels/block_table.h"

namespace dhpmap {

/// "tsdf tile (1, -2, 0)", for messages.
inline std::string NameOfTile(const std::string& layer, TileIndex index) {
  return layer + " tile (" + std::to_string(index.x) + ", " + std::to_string(index.y) + ", " + std::to_string(index.z) +
         ")";
}

}  // namespace dhpmap

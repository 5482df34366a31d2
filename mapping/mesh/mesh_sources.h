// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// A tile that has blocks of a surface.
struct SourceTile {
  const Submap* submap = nullptr;
  const BlockTile* tile = nullptr;
  std::size_t num_blocks = 0;  ///< that have to do with it; at least one
};

/// What decides about the surfaces of some objects (ExtractObjectMeshes): nothing else of the map does. Refers to it.
struct MeshSources {
  std::vector<const Submap*> on_grid;  ///< of those wanted that are cut from the map's one surface
  std::vector<const Submap*> around;   ///< themselves, and what shares their grid, is present and near; ascending
  IndexMap<BlockIndex> blocks;         ///< those of on_grid, and one around them
  std::vector<SourceTile> tiles;       ///< with some of these blocks, and all of what is wanted and not on the grid
};

/// `wanted` are of the map. Costs their blocks, and a look at the tiles of what is near; reads none of them.
MeshSources MeshSourcesOf(const MapSnapshot& map, std::span<const Submap* const> wanted);

/// How many of a tile's blocks are among `blocks`. Reads none.
std::size_t NumBlocksIn(const TileEntry& tile, const IndexMap<BlockIndex>& blocks);

/// Whether the submap's surface is cut from that of all that share the map's grid; else it is meshed by itself.
bool IsCutFromMap(const MapSnapshot& map, const Submap& submap);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mapping/base/index_map.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// A tile with blocks that affect a surface.
struct SourceTile {
  const Submap* submap = nullptr;
  const BlockTile* tile = nullptr;
  std::size_t num_blocks = 0;  ///< that affect it; at least one
};

/// The parts of a map that determine the surfaces of some objects (ExtractObjectMeshes). Refers to the map.
struct MeshSources {
  std::vector<const Submap*> on_grid;  ///< the wanted submaps that are cut from the map's one surface
  std::vector<const Submap*> around;   ///< these, and present submaps nearby that share their grid; ascending
  IndexMap<BlockIndex> blocks;         ///< those of on_grid, and their neighbours
  std::vector<SourceTile> tiles;       ///< tiles with these blocks, and all tiles of wanted submaps off the grid
};

/// `wanted` are submaps of the map. Costs a look at their blocks and at the tiles of submaps nearby; reads no voxels.
MeshSources MeshSourcesOf(const MapSnapshot& map, std::span<const Submap* const> wanted);

/// Number of a tile's blocks in `blocks`. Reads none.
std::size_t NumBlocksIn(const TileEntry& tile, const IndexMap<BlockIndex>& blocks);

/// Whether the submap's surface is cut from that of all that share the map's grid; else it is meshed by itself.
bool IsCutFromMap(const MapSnapshot& map, const Submap& submap);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/mesh/tile_blocks.h"

namespace dhpmap {

/// Corners in metres, counter-clockwise seen from the front, where distances are positive.
using SurfaceTriangle = std::array<Eigen::Vector3f, 3>;

/// Triangles of a submap's surface, and the other submaps that they depend on.
struct TileSurface {
  std::vector<SurfaceTriangle> triangles;
  std::vector<std::uint16_t> needs;           ///< index into `needed` for each triangle; empty: 0 for all
  std::vector<std::vector<SubmapId>> needed;  ///< ascending, unique; the first: none
};

/// The part of a submap's zero surface that belongs to one of its tiles, relative to the tile's lowest corner
/// (TileCorner), along the axes of the submap's frame: marching cubes over the cells with 8 valid corners
/// (BlockEntry::Shows), without extrapolation. `sharers`: other submaps of the same grid, by ascending id, with
/// exclusive positions. A cell with corners in several submaps belongs to the known one with most of them (ties: the
/// smallest id), and depends on the others. So all surfaces together are that of the whole map (ExtractMapMesh), are
/// closed between neighbours, and without some of the submaps give the surface of the rest. While positions are not
/// exclusive yet, each submap shows its own voxels and, at its border, those of the sharer of smallest id. A cell
/// belongs to the tile of the first valid corner of its submap, so to exactly one tile.
TileSurface ExtractTileSurface(const TileOwner& own, std::span<const TileOwner> sharers, double voxel_size_m);

/// Of one submap alone.
std::vector<SurfaceTriangle> ExtractTileSurface(const TileBlocks& blocks, double voxel_size_m);

/// In metres of the submap frame.
Eigen::Vector3d TileCorner(TileIndex tile, double voxel_size_m);

}  // namespace dhpmap

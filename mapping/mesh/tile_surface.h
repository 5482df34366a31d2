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

/// Triangles of a submap's surface, and which others they take to be there.
struct TileSurface {
  std::vector<SurfaceTriangle> triangles;
  std::vector<std::uint16_t> needs;           ///< of each triangle, in `needed`; empty: all are the first
  std::vector<std::vector<SubmapId>> needed;  ///< ascending, each once; the first: nobody
};

/// The part of a submap's zero surface that belongs to one of its tiles, relative to the tile's corner of least
/// coordinates (TileCorner), along the axes of the submap's frame: marching cubes over the cells whose 8 corners are
/// shown (BlockEntry::Shows), and nothing beyond. `sharers`: others on the same grid, by ascending id, with which it
/// has made positions exclusive. A cell with corners of several belongs to the known one that has most of them, of
/// equals to the least id, and needs the others; so all surfaces together are that of the whole map (ExtractMapMesh),
/// they close where neighbours meet, and without some of the submaps what is left is the surface of the others. While
/// positions are not exclusive yet, each shows what it holds itself, and at its border what the sharer of least id
/// does. A cell belongs to the tile of the first corner that its submap shows, so each is in exactly one tile.
TileSurface ExtractTileSurface(const TileOwner& own, std::span<const TileOwner> sharers, double voxel_size_m);

/// Of a submap alone.
std::vector<SurfaceTriangle> ExtractTileSurface(const TileBlocks& blocks, double voxel_size_m);

/// In metres of the submap frame.
Eigen::Vector3d TileCorner(TileIndex tile, double voxel_size_m);

}  // namespace dhpmap

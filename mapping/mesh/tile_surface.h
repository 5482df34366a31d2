// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <bitset>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/map/submap.h"

namespace dhpmap {

/// Corners in metres, counter-clockwise seen from the front, where distances are positive.
using SurfaceTriangle = std::array<Eigen::Vector3f, 3>;

/// The tiles whose voxels a tile's surface is made of: itself and those around it, at offsets -1 to 1, x fastest. Null
/// where there is none. While these are the same objects, the surface is the same.
using TileNeighbourhood = std::array<const TileEntry*, 27>;
TileNeighbourhood FindNeighbourhood(const BlockTable& blocks, TileIndex tile);

/// The blocks of them that it is made of: the tile's own and those that touch it, at offsets -1 to kTileSide from its
/// first, x fastest. Null where there is no TSDF. While what these show of a surface is the same, so is the surface.
using TileBlocks = std::array<const BlockEntry*, std::size_t{kTileSide + 2} * (kTileSide + 2) * (kTileSide + 2)>;
/// Where such a block is, in blocks from the tile's first.
constexpr BlockIndex OffsetInTile(int number) {
  constexpr int kAround = kTileSide + 2;
  return {number % kAround - 1, number / kAround % kAround - 1, number / (kAround * kAround) - 1};
}
TileBlocks FindBlocks(const TileNeighbourhood& around, TileIndex tile);

/// Some places of TileBlocks, and these with all that touch one of them: of a submap that shares the grid nothing else
/// matters to who has blocks at the first.
using TilePlaces = std::bitset<std::tuple_size_v<TileBlocks>>;
TilePlaces Widened(const TilePlaces& places);

/// What such a block shows a surface by (see PartId); 0 where there is none.
struct SurfaceNames {
  std::uint64_t tsdf = 0, gone = 0;
};
/// Of all of FindBlocks, without reading any that are on the disk.
using TileNames = std::array<SurfaceNames, std::tuple_size_v<TileBlocks>>;
TileNames FindNames(const TileNeighbourhood& around, TileIndex tile);

/// A submap's blocks around a tile.
struct TileOwner {
  SubmapId id;
  TileBlocks blocks{};
};

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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
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

/// What such a block shows a surface by (see PartId); 0 where there is none.
struct SurfaceNames {
  std::uint64_t tsdf = 0, gone = 0;
};
/// Of all of FindBlocks, without reading any that are on the disk.
using TileNames = std::array<SurfaceNames, std::tuple_size_v<TileBlocks>>;
TileNames FindNames(const TileNeighbourhood& around, TileIndex tile);

/// The part of a submap's zero surface that belongs to one of its tiles, relative to the tile's corner of least
/// coordinates (TileCorner), along the axes of the submap's frame. Marching cubes as in a mesh of the submap alone, but
/// the surface reaches one voxel over the border of what is observed, where values are extrapolated from the observed
/// voxels around, but not where a sensor has looked through (GoneBlock): so the surfaces of neighbours that label
/// management has made exclusive close, whatever becomes of either. It depends on the submap's own voxels only. A cell
/// with an observed corner belongs to the tile of the first of these, so each is in exactly one tile.
std::vector<SurfaceTriangle> ExtractTileSurface(const TileBlocks& blocks, double voxel_size_m);

/// In metres of the submap frame.
Eigen::Vector3d TileCorner(TileIndex tile, double voxel_size_m);

}  // namespace dhpmap

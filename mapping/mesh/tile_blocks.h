// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "mapping/submap/submap.h"

namespace dhpmap {

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

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// The tiles that affect a tile's surface: the tile itself and its neighbours, at offsets -1 to 1, x fastest; null
/// where there is none. While these are the same objects, the surface is the same.
using TileNeighbourhood = std::array<const TileEntry*, 27>;
TileNeighbourhood FindNeighbourhood(const BlockTable& blocks, TileIndex tile);

/// The blocks that affect a tile's surface: its own and those that touch it, at offsets -1 to kTileSide from its first,
/// x fastest; null where there is no TSDF. While their surface layers are the same, so is the surface.
using TileBlocks = std::array<const BlockEntry*, std::size_t{kTileSide + 2} * (kTileSide + 2) * (kTileSide + 2)>;
/// The position of such a block, in blocks from the tile's first.
constexpr BlockIndex OffsetInTile(int number) {
  constexpr int kAround = kTileSide + 2;
  return {number % kAround - 1, number / kAround % kAround - 1, number / (kAround * kAround) - 1};
}
TileBlocks FindBlocks(const TileNeighbourhood& around, TileIndex tile);

/// A set of positions of TileBlocks. Widened adds all positions that touch one of them: the only blocks of another
/// submap on the grid that affect the surface of a submap with blocks at `places`.
using TilePlaces = std::bitset<std::tuple_size_v<TileBlocks>>;
TilePlaces Widened(const TilePlaces& places);

/// Names (PartId) of the layers of a block that define its surface; 0: no layer.
struct SurfaceNames {
  std::uint64_t tsdf = 0, gone = 0;
};
/// The names of all blocks of FindBlocks, without reading blocks from disk.
using TileNames = std::array<SurfaceNames, std::tuple_size_v<TileBlocks>>;
TileNames FindNames(const TileNeighbourhood& around, TileIndex tile);

/// A submap's blocks around a tile.
struct TileOwner {
  SubmapId id;
  TileBlocks blocks{};
};

}  // namespace dhpmap

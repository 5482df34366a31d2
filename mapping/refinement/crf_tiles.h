// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// One submap's block at one index.
struct HeldBlock {
  BlockIndex index;
  SubmapId holder;
  const BlockEntry* entry;
};

/// All labelled blocks of the submaps `ids` on the map's grid, by ascending index, then holder. Valid until the map is
/// next written.
std::vector<HeldBlock> CollectBlocks(std::span<const SubmapId> ids, const Map& map);

/// A cube of blocks that the CRF solves at once, with the blocks around it whose labels reach into it. Indices into the
/// list of CollectBlocks, ascending.
struct CrfTile {
  std::vector<std::uint32_t> inner;
  std::vector<std::uint32_t> rim;
};

/// Cuts the blocks into cubes of `side` blocks with a rim of `rim` blocks. Leaves out tiles in which nothing is in
/// dispute: all voxels, rim included, saw one instance and one class, the same everywhere.
std::vector<CrfTile> CutTiles(std::span<const HeldBlock> blocks, int side, int rim);

/// Leaves out tiles of which no block, rim included, was written since `before`.
void DropUnchanged(std::span<const HeldBlock> blocks, const MapSnapshot& before, std::vector<CrfTile>& tiles);

}  // namespace dhpmap

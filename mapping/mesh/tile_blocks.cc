// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/tile_blocks.h"

#include <algorithm>

namespace dhpmap {

TileNeighbourhood FindNeighbourhood(const BlockTable& blocks, TileIndex tile) {
  TileNeighbourhood around;
  for (int i = 0; i < 27; ++i) {
    around[static_cast<std::size_t>(i)] =
        blocks.FindTile({tile.x + i % 3 - 1, tile.y + i / 3 % 3 - 1, tile.z + i / 9 - 1});
  }
  return around;
}

namespace {

/// Calls visit(number, tile, cell) for the places of FindBlocks that have a tile.
template <typename Visitor>
void ForEachPlace(const TileNeighbourhood& around, TileIndex tile, Visitor&& visit) {
  const BlockIndex first = BlockIn(tile, 0);
  for (int i = 0; i < static_cast<int>(std::tuple_size_v<TileBlocks>); ++i) {
    const BlockIndex offset = OffsetInTile(i);
    const TileIndex step = TileOf(offset);  // to the neighbouring tile: -1, 0 or 1 along each axis
    const int neighbour = (step.x + 1) + 3 * (step.y + 1) + 9 * (step.z + 1);
    const TileEntry* entry = around[static_cast<std::size_t>(neighbour)];
    if (entry == nullptr) continue;
    visit(static_cast<std::size_t>(i), *entry->tile,
          CellOf({first.x + offset.x, first.y + offset.y, first.z + offset.z}));
  }
}

SurfaceNames NamesOf(const BlockTile& tile, int cell) {
  if (const TileLoader* loader = tile.loader().get()) {
    const std::uint64_t tsdf = loader->PartIdOf(BlockLayer::kTsdf, cell);
    return tsdf == 0 ? SurfaceNames() : SurfaceNames{tsdf, loader->PartIdOf(BlockLayer::kGone, cell)};
  }
  const BlockEntry* block = tile.Find(cell);
  if (block == nullptr || block->tsdf == nullptr) return {};
  return {block->tsdf->part_id.value(), block->gone != nullptr ? block->gone->part_id.value() : 0};
}

}  // namespace

TileBlocks FindBlocks(const TileNeighbourhood& around, TileIndex tile) {
  TileBlocks blocks{};
  ForEachPlace(around, tile, [&](std::size_t i, const BlockTile& there, int cell) {
    const BlockEntry* block = there.Find(cell);
    if (block != nullptr && block->tsdf != nullptr) blocks[i] = block;
  });
  return blocks;
}

TileNames FindNames(const TileNeighbourhood& around, TileIndex tile) {
  TileNames names{};
  ForEachPlace(around, tile, [&](std::size_t i, const BlockTile& there, int cell) { names[i] = NamesOf(there, cell); });
  return names;
}

TilePlaces Widened(const TilePlaces& places) {
  constexpr int kAround = kTileSide + 2;
  TilePlaces wider;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    const BlockIndex centre = OffsetInTile(static_cast<int>(i));
    for (int k = 0; k < 27; ++k) {
      const int x = centre.x + k % 3, y = centre.y + k / 3 % 3, z = centre.z + k / 9;  // from 0
      if (std::min({x, y, z}) < 0 || std::max({x, y, z}) >= kAround) continue;
      wider.set(static_cast<std::size_t>(x + kAround * (y + kAround * z)));
    }
  }
  return wider;
}

}  // namespace dhpmap

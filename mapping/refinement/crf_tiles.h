// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/thread_pool.h"
#include "mapping/map/map.h"
#include "mapping/map/state_marks.h"
#include "mapping/refinement/seen_instances.h"

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

/// Calls visit(BlockIndex) for all indices within `rim` of `center`, itself included.
template <typename Visitor>
void VisitBlocksAround(BlockIndex center, int rim, Visitor&& visit) {
  for (std::int32_t x = center.x - rim; x <= center.x + rim; ++x) {
    for (std::int32_t y = center.y - rim; y <= center.y + rim; ++y) {
      for (std::int32_t z = center.z - rim; z <= center.z + rim; ++z) visit(BlockIndex{x, y, z});
    }
  }
}

/// Blocks of a cube that the CRF solves at once, with the blocks around them whose labels reach into them. Indices into
/// the list of CollectBlocks, ascending.
struct CrfTile {
  std::vector<std::uint32_t> inner;
  std::vector<std::uint32_t> rim;
};

/// Cuts the blocks into cubes of `side` blocks; what lies within `rim` blocks of an inner block is in its tile, too.
/// Blocks are left out where nothing is in dispute: if all voxels within `rim` blocks have seen the same instance most,
/// and none another as often, then it gets the largest message everywhere and stays the first choice. What was
/// concluded before may be otherwise now: it is in dispute. Largest tiles first.
std::vector<CrfTile> CutTiles(std::span<const HeldBlock> blocks, const KnownInstances& known, int side, int rim,
                              ThreadPool& pool);

/// Leaves out tiles of which no block, rim included, was written since `before`.
void DropUnchanged(std::span<const HeldBlock> blocks, const StateMarks& before, std::vector<CrfTile>& tiles);

}  // namespace dhpmap

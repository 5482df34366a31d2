// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/refinement_scratch.h"
#include "mapping/base/thread_pool.h"
#include "mapping/evidence/known_instances.h"
#include "mapping/evidence/refinement_region.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// One submap's block at one index.
struct HeldBlock {
  BlockIndex index;
  SubmapId holder;
  const BlockEntry* entry;
  float most_distance_m = 0;  ///< voxels up to this distance from a surface take part

  /// Whether a labelled voxel takes part in the CRF. Labels of voxels far from a surface are in no answer and less
  /// often right, so they do not. Voxels with an earlier conclusion always take part.
  [[nodiscard]] bool TakesPart(int linear) const {
    if (!entry->Shows(linear) || entry->labels->IsEmpty(linear)) return false;
    const float distance_m = std::abs(entry->tsdf->distance_m[static_cast<std::size_t>(linear)]);
    return distance_m <= most_distance_m || entry->labels->IsConcluded(linear);
  }
};

/// All labelled blocks of the submaps `ids` that share the map's grid (IsExclusive), by ascending index, then holder;
/// with `region`, those within `rim` blocks of it. Valid until the map is next written.
ScratchVector<HeldBlock> CollectBlocks(std::span<const SubmapId> ids, const Map& map,
                                       const RefinementRegion* region = nullptr, int rim = 0);

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
  ScratchVector<std::uint32_t> inner;
  ScratchVector<std::uint32_t> rim;
};

/// Divides the blocks into cubes of `side` blocks; with `region`, only its blocks. A tile also has the blocks within
/// `rim` blocks of an inner block. Undisputed blocks are left out: if all voxels within `rim` blocks have the same most
/// frequent instance, without a tie, that instance gets the largest message everywhere and stays the first choice.
/// Voxels with an earlier conclusion are disputed, because the conclusion may change. Largest tiles first.
std::vector<CrfTile> CutTiles(std::span<const HeldBlock> blocks, const KnownInstances& known, int side, int rim,
                              ThreadPool& pool, const RefinementRegion* region = nullptr);

}  // namespace dhpmap

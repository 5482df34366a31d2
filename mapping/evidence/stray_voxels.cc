// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/evidence/stray_voxels.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mapping/base/refinement_scratch.h"
#include "mapping/evidence/known_instances.h"
#include "mapping/evidence/voxel_handover.h"
#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMostStrayVoxels = 16;
constexpr std::size_t kLeastRatio = 10;  // of the largest island to a stray one

using Island = std::vector<VoxelIndex>;
/// Who holds blocks at an index.
using Holders = std::unordered_map<BlockIndex, ScratchVector<const Submap*>, BlockIndexHash, std::equal_to<>,
                                   ScratchAllocator<std::pair<const BlockIndex, ScratchVector<const Submap*>>>>;

struct Stray {
  SubmapId from, to;
  Island voxels;
};

template <typename Visitor>
void VisitNeighbours(VoxelIndex v, Visitor&& visit) {
  for (int n = 0; n < 27; ++n) {
    if (n != 13) visit(VoxelIndex{v.x + n % 3 - 1, v.y + n / 3 % 3 - 1, v.z + n / 9 - 1});
  }
}

bool ShowsIn(const Submap& submap, VoxelIndex v) {
  const BlockEntry* entry = submap.blocks().Find(BlockOf(v));
  return entry != nullptr && entry->tsdf != nullptr && entry->Shows(LinearIndex(v));
}

/// Voxels of a submap that no island has yet.
class OpenVoxels {
 public:
  /// All of the submap but those that are contradicted.
  explicit OpenVoxels(const Submap& submap) {
    for (const BlockEntry& entry : submap.blocks().entries()) {
      std::array<bool, kBlockVoxels>& flags = blocks_[entry.index];
      for (int i = 0; i < kBlockVoxels; ++i) flags[static_cast<std::size_t>(i)] = entry.tsdf && entry.Shows(i);
    }
  }
  /// Returns whether it was there.
  bool Take(VoxelIndex v) {
    const auto it = blocks_.find(BlockOf(v));
    return it != blocks_.end() && std::exchange(it->second[static_cast<std::size_t>(LinearIndex(v))], false);
  }

 private:
  using Flags = std::array<bool, kBlockVoxels>;
  std::unordered_map<BlockIndex, Flags, BlockIndexHash, std::equal_to<>,
                     ScratchAllocator<std::pair<const BlockIndex, Flags>>>
      blocks_;
};

struct Islands {
  std::vector<Island> small;  ///< of at most kMostStrayVoxels
  std::size_t largest = 0;    ///< voxels, of all
};

/// The submap's voxels, but those that are contradicted, in connected islands, corners included.
Islands FindIslands(const Submap& submap) {
  OpenVoxels open(submap);
  Islands islands;
  ScratchVector<VoxelIndex> island;  // one after the other
  for (const BlockEntry& entry : submap.blocks().entries()) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!open.Take(VoxelIn(entry.index, i))) continue;
      island.assign(1, VoxelIn(entry.index, i));
      for (std::size_t next = 0; next < island.size(); ++next) {
        const VoxelIndex here = island[next];
        VisitNeighbours(here, [&](VoxelIndex v) {
          if (open.Take(v)) island.push_back(v);
        });
      }
      islands.largest = std::max(islands.largest, island.size());
      if (island.size() <= kMostStrayVoxels) islands.small.emplace_back(island.begin(), island.end());
    }
  }
  return islands;
}

/// The submap that holds most voxels around the island; ties go to the smaller id, the unknown submap has no say.
std::optional<SubmapId> SurroundingOf(const Island& island, SubmapId own, const Holders& holders) {
  std::map<SubmapId, int> votes;
  for (const VoxelIndex voxel : island) {
    VisitNeighbours(voxel, [&](VoxelIndex v) {
      const auto it = holders.find(BlockOf(v));
      if (it == holders.end()) return;
      for (const Submap* submap : it->second) {
        if (submap->id() != own && submap->id() != kUnknownSubmap && ShowsIn(*submap, v)) ++votes[submap->id()];
      }
    });
  }
  const auto best =
      std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return best == votes.end() ? std::nullopt : std::optional(best->first);
}

std::vector<Stray> FindStrays(const Submap& submap, const Holders& holders) {
  std::vector<Stray> strays;
  Islands islands = FindIslands(submap);
  for (Island& island : islands.small) {
    if (island.size() * kLeastRatio >= islands.largest) continue;
    const auto to = SurroundingOf(island, submap.id(), holders);
    if (to) strays.push_back({submap.id(), *to, std::move(island)});
  }
  return strays;
}

}  // namespace

std::int64_t AbsorbStrayVoxels(std::span<const SubmapId> ids, Map& map, ThreadPool& pool) {
  Holders holders;
  std::vector<const Submap*> things;
  for (const SubmapId id : ids) {
    const Submap* submap = map.Find(id);
    if (submap == nullptr || !IsExclusive(submap->info(), map.info().config)) continue;
    for (const BlockEntry& entry : submap->blocks().entries()) holders[entry.index].push_back(submap);
    if (submap->info().panoptic == Panoptic::kThing) things.push_back(submap);
  }
  std::vector<std::vector<Stray>> strays(things.size());
  pool.ParallelFor(things.size(), [&](std::size_t i) { strays[i] = FindStrays(*things[i], holders); });

  const KnownInstances known(ids, map);
  ScratchVector<Handover> handovers;
  for (const std::vector<Stray>& of_one : strays) {
    for (const Stray& stray : of_one) {
      for (const VoxelIndex v : stray.voxels) {
        const LabelBlock* labels = map.Find(stray.from)->blocks().Find(BlockOf(v))->labels.get();
        const int linear = LinearIndex(v);
        if (labels == nullptr || labels->IsEmpty(linear)) continue;  // never labelled: nothing says whose it is
        const bool is_concluded = known.MostSeen(stray.from, *labels, linear) != stray.to;
        handovers.push_back({BlockOf(v), static_cast<std::uint16_t>(linear), stray.from, stray.to, is_concluded});
      }
    }
  }
  const auto num_voxels = static_cast<std::int64_t>(handovers.size());
  HandOver(std::move(handovers), map, pool);
  return num_voxels;
}

}  // namespace dhpmap

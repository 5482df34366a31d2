// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/stray_voxels.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mapping/map/map_grid.h"
#include "mapping/refinement/seen_instances.h"
#include "mapping/refinement/voxel_handover.h"

namespace dhpmap {
namespace {

constexpr std::size_t kMostStrayVoxels = 16;
constexpr std::size_t kLeastRatio = 10;  // of the largest island to a stray one

using Island = std::vector<VoxelIndex>;
/// Who holds blocks at an index.
using Holders = std::unordered_map<BlockIndex, std::vector<const Submap*>, BlockIndexHash>;

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

/// The submap's voxels, but those that are contradicted, in connected islands, corners included.
std::vector<Island> FindIslands(const Submap& submap) {
  std::unordered_map<BlockIndex, std::unique_ptr<std::array<bool, kBlockVoxels>>, BlockIndexHash> open;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    auto& flags = open[entry.index] = std::make_unique<std::array<bool, kBlockVoxels>>();
    for (int i = 0; i < kBlockVoxels; ++i) (*flags)[static_cast<std::size_t>(i)] = entry.tsdf && entry.Shows(i);
  }
  const auto take = [&open](VoxelIndex v) {
    const auto it = open.find(BlockOf(v));
    return it != open.end() && std::exchange((*it->second)[static_cast<std::size_t>(LinearIndex(v))], false);
  };
  std::vector<Island> islands;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!take(VoxelIn(entry.index, i))) continue;
      Island island{VoxelIn(entry.index, i)};
      for (std::size_t next = 0; next < island.size(); ++next) {
        VisitNeighbours(island[next], [&](VoxelIndex v) {
          if (take(v)) island.push_back(v);
        });
      }
      islands.push_back(std::move(island));
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
  std::vector<Island> islands = FindIslands(submap);
  std::size_t largest = 0;
  for (const Island& island : islands) largest = std::max(largest, island.size());
  for (Island& island : islands) {
    if (island.size() > kMostStrayVoxels || island.size() * kLeastRatio >= largest) continue;
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
  std::vector<Handover> handovers;
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

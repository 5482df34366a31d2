// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/apart_things.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "mapping/map/map_grid.h"
#include "mapping/objects/pair_evidence.h"
#include "mapping/objects/split_submap.h"

namespace dhpmap {
namespace {

/// A connected set of cells. Cells are addressed by BlockIndex, and ordered, so the order of blocks in memory does not
/// matter.
struct Island {
  std::set<BlockIndex> cells;
  std::int64_t num_surface_voxels = 0;
};

constexpr std::int32_t FloorOf(std::int32_t a, std::int32_t b) { return (a >= 0 ? a : a - b + 1) / b; }

BlockIndex PlaceCellOf(VoxelIndex v, int cell_vox) {
  return {FloorOf(v.x, cell_vox), FloorOf(v.y, cell_vox), FloorOf(v.z, cell_vox)};
}

/// Number of surface voxels in each cell that has any visible voxel.
std::map<BlockIndex, std::int64_t> CountByCell(const Submap& submap, int cell_vox) {
  std::map<BlockIndex, std::int64_t> cells;
  const double most_m = submap.info().voxel_size_m / 2;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    if (entry.tsdf == nullptr) continue;
    for (int i = 0; i < kBlockVoxels; ++i) {
      if (!entry.Shows(i)) continue;
      const double distance_m = entry.tsdf->distance_m[static_cast<std::size_t>(i)];
      cells[PlaceCellOf(VoxelIn(entry.index, i), cell_vox)] += std::abs(distance_m) <= most_m;
    }
  }
  return cells;
}

/// Removes one cell and all cells connected to it from the list.
Island TakeIsland(std::map<BlockIndex, std::int64_t>& cells) {
  Island island;
  std::vector<BlockIndex> open{cells.begin()->first};
  while (!open.empty()) {
    const BlockIndex cell = open.back();
    open.pop_back();
    const auto found = cells.find(cell);
    if (found == cells.end()) continue;
    island.num_surface_voxels += found->second;
    island.cells.insert(cell);
    cells.erase(found);
    for (int n = 0; n < 27; ++n) open.push_back({cell.x + n % 3 - 1, cell.y + n / 3 % 3 - 1, cell.z + n / 9 - 1});
  }
  return island;
}

/// Largest first; on ties the one with the smaller first cell first.
std::vector<Island> IslandsOf(const Submap& submap, int cell_vox) {
  std::map<BlockIndex, std::int64_t> cells = CountByCell(submap, cell_vox);
  std::vector<Island> islands;
  while (!cells.empty()) islands.push_back(TakeIsland(cells));
  std::stable_sort(islands.begin(), islands.end(),
                   [](const Island& a, const Island& b) { return a.num_surface_voxels > b.num_surface_voxels; });
  return islands;
}

/// Whether a user has made one object of it and whatever was merged into it.
bool MustBeOne(SubmapId id, const ObjectPairs& pairs) {
  return std::any_of(pairs.pairs().begin(), pairs.pairs().end(), [id](const ObjectPair& pair) {
    return pair.verdict == PairVerdict::kMustBeOne && (pair.first == id || pair.second == id);
  });
}

bool MayBeSeveral(const Submap& submap, const MapInfo& map) {
  const SubmapInfo& info = submap.info();
  return info.panoptic == Panoptic::kThing && info.activity == Activity::kInactive && info.is_confirmed &&
         IsExclusive(info, map.config) && !submap.IsAbsent() && !IsEdited(info) && info.edited_revision == 0 &&
         !info.is_locked && info.track_id == 0 && !info.sightings.HasTrack() && !MustBeOne(info.id, map.pairs);
}

/// Records evidence from frames. Only a split by a user is permanent.
void NoteAsSeenApart(SubmapId a, SubmapId b, ObjectPairs& pairs) {
  pairs.SetVerdict(a, b, PairVerdict::kOpen);
  pairs.AddEvidence(a, b, kLeastEvidence, kLeastEvidence, ObjectPairs::kMostEvidence);
}

void KeepVerdicts(SubmapId whole, SubmapId part, ObjectPairs& pairs) {
  std::vector<SubmapId> others;
  for (const ObjectPair& pair : pairs.pairs()) {
    if (pair.verdict != PairVerdict::kMustBeTwo) continue;
    if (pair.first == whole && pair.second != part) others.push_back(pair.second);
    if (pair.second == whole && pair.first != part) others.push_back(pair.first);
  }
  for (const SubmapId other : others) pairs.SetVerdict(part, other, PairVerdict::kMustBeTwo);
}

int SplitIslands(SubmapId id, int cell_vox, std::int64_t least_surface_voxels, Map& map) {
  const std::vector<Island> islands = IslandsOf(*map.Find(id), cell_vox);
  const double voxel_size_m = map.Find(id)->info().voxel_size_m;
  std::vector<SubmapId> parts{id};
  for (std::size_t i = 1; i < islands.size() && parts.size() < std::size_t{kMostApartParts}; ++i) {
    const Island& island = islands[i];
    if (island.num_surface_voxels < std::max<std::int64_t>(1, least_surface_voxels)) break;
    const VoxelChoice goes = [&](const Eigen::Vector3d& p_m) {
      return island.cells.contains(PlaceCellOf(VoxelAt(p_m, voxel_size_m), cell_vox));
    };
    const std::optional<SubmapId> part = SplitSubmap(id, goes, map);
    if (!part) continue;
    ObjectPairs& pairs = map.mutable_info().pairs;
    for (const SubmapId other : parts) NoteAsSeenApart(other, *part, pairs);
    KeepVerdicts(id, *part, pairs);
    parts.push_back(*part);
  }
  return static_cast<int>(parts.size()) - 1;
}

}  // namespace

int SplitApartThings(int cell_vox, std::int64_t least_surface_voxels, Map& map) {
  if (cell_vox <= 0) return 0;
  std::vector<SubmapId> things;
  for (const auto& submap : map.submaps()) {
    if (MayBeSeveral(*submap, map.info())) things.push_back(submap->id());
  }
  int num_made = 0;
  for (const SubmapId id : things) num_made += SplitIslands(id, cell_vox, least_surface_voxels, map);
  return num_made;
}

}  // namespace dhpmap

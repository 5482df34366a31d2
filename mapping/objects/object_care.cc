// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/object_care.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "mapping/map/map_grid.h"
#include "mapping/objects/merge_submaps.h"
#include "mapping/objects/pair_evidence.h"
#include "mapping/objects/surface_voxels.h"
#include "mapping/tracking/activity.h"

namespace dhpmap {
namespace {

/// Two voxels are not a surface: the smallest thing that a frame creates has more points in more voxels.
constexpr std::int64_t kLeastSurfaceVoxels = 3;
/// A thing with fewer surface voxels is a remnant if others hold more than kTakenTimes as many observations of it as it
/// does itself. Measured on rooms at 4 cm: ratios of 5 to 84 for false things, at most 3.3 for true ones, among them a
/// cup of 8 voxels.
constexpr std::int64_t kFewSurfaceVoxels = 30;
constexpr std::uint64_t kTakenTimes = 4;

/// A merge would have to write to a locked submap.
bool IsNamedByLocked(SubmapId id, const Map& map) {
  return std::any_of(map.submaps().begin(), map.submaps().end(), [id](const auto& submap) {
    if (!submap->info().is_locked) return false;
    const auto entries = submap->blocks().entries();
    return std::any_of(entries.begin(), entries.end(), [id](const BlockEntry& entry) {
      return entry.labels != nullptr && entry.labels->HasSeenInstance(id);
    });
  });
}

bool ShouldMerge(const ObjectPair& pair, const Map& map) {
  if (pair.verdict == PairVerdict::kMustBeTwo || !CanMerge(map, pair.second, pair.first)) return false;
  const Submap& a = *map.Find(pair.first);
  const Submap& b = *map.Find(pair.second);
  if (a.info().is_locked || b.info().is_locked) return false;
  if (pair.verdict == PairVerdict::kMustBeOne) return !IsNamedByLocked(pair.second, map);
  return pair.evidence >= kIsOne && a.info().class_id == b.info().class_id && !IsEdited(a.info()) &&
         !IsEdited(b.info()) && !a.IsAbsent() && !b.IsAbsent() && SurfacesTouch(a, b) &&
         !IsNamedByLocked(pair.second, map);
}

/// Number of observations of the thing by frames, by the holder of the voxels.
struct SightsOfThing {
  std::uint64_t own = 0, others = 0;
};

void CountSights(SubmapId thing, const Submap& holder, const LabelBlock& labels, SightsOfThing& sights) {
  if (holder.id() != thing && !labels.HasSeenInstance(thing)) return;
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    labels.VisitInstances(linear, [&](const InstanceCount& seen) {
      if (seen.id.In(holder.id()) == thing) (holder.id() == thing ? sights.own : sights.others) += seen.count;
    });
  }
}

/// Counted in the thing's blocks and those next to them.
SightsOfThing SightsAround(const Submap& thing, const Map& map) {
  std::set<BlockIndex> around;
  for (const BlockEntry& entry : thing.blocks().entries()) {
    if (entry.tsdf == nullptr || !entry.tsdf->HasObservedVoxel()) continue;
    const BlockIndex at = entry.index;
    for (int n = 0; n < 27; ++n) around.insert({at.x + n % 3 - 1, at.y + n / 3 % 3 - 1, at.z + n / 9 - 1});
  }
  SightsOfThing sights;
  for (const auto& holder : map.submaps()) {
    if (!IsExclusive(holder->info(), map.info().config)) continue;
    for (const BlockIndex index : around) {
      const BlockEntry* entry = holder->blocks().Find(index);
      if (entry != nullptr && entry->labels != nullptr) CountSights(thing.id(), *holder, *entry->labels, sights);
    }
  }
  return sights;
}

bool IsRemnant(const Submap& thing, const Map& map) {
  if (!HasSurfaceVoxels(thing, kLeastSurfaceVoxels)) return true;
  if (HasSurfaceVoxels(thing, kFewSurfaceVoxels)) return false;
  const SightsOfThing sights = SightsAround(thing, map);
  return sights.others > kTakenTimes * sights.own;
}

}  // namespace

int MergePairs(Map& map, std::size_t most_blocks) {
  int num_merged = 0;
  for (std::size_t num_blocks = 0; num_blocks < most_blocks;) {
    const auto pairs = map.info().pairs.pairs();
    const auto pair =
        std::find_if(pairs.begin(), pairs.end(), [&map](const ObjectPair& p) { return ShouldMerge(p, map); });
    if (pair == pairs.end()) break;
    const auto [first, second, verdict] = std::tuple(pair->first, pair->second, pair->verdict);
    num_blocks += map.Find(second)->blocks().size() + 1;
    if (verdict == PairVerdict::kMustBeOne) MergeForGood(second, first, map);
    else MergeSubmaps(second, first, map);
    ++num_merged;
  }
  return num_merged;
}

int DissolveRemnants(Map& map) {
  std::vector<SubmapId> remnants;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    const bool is_settled = info.panoptic == Panoptic::kThing && info.activity == Activity::kInactive;
    if (!is_settled || submap->IsAbsent() || IsEdited(info) || info.is_locked || info.track_id != 0) continue;
    if (IsRemnant(*submap, map)) remnants.push_back(info.id);
  }
  return static_cast<int>(
      std::count_if(remnants.begin(), remnants.end(), [&map](SubmapId id) { return DissolveIntoUnknown(id, map); }));
}

}  // namespace dhpmap

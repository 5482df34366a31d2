// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/objects/object_care.h"

#include <algorithm>
#include <vector>

#include "mapping/objects/merge_submaps.h"
#include "mapping/objects/pair_evidence.h"
#include "mapping/objects/surface_voxels.h"
#include "mapping/tracking/activity.h"

namespace dhpmap {
namespace {

/// Two voxels are no surface: the smallest thing that a frame can make has more points in more of them.
constexpr std::int64_t kLeastSurfaceVoxels = 3;

bool ShouldMerge(const ObjectPair& pair, const Map& map) {
  if (pair.verdict == PairVerdict::kMustBeTwo || !CanMerge(map, pair.second, pair.first)) return false;
  if (pair.verdict == PairVerdict::kMustBeOne) return true;
  const Submap& a = *map.Find(pair.first);
  const Submap& b = *map.Find(pair.second);
  return pair.evidence >= kIsOne && a.info().class_id == b.info().class_id && !IsEdited(a.info()) &&
         !IsEdited(b.info()) && !a.IsAbsent() && !b.IsAbsent() && SurfacesTouch(a, b);
}

}  // namespace

bool IsEdited(const SubmapInfo& info) { return info.is_placed || info.class_is_fixed || !info.display_name.empty(); }

int MergePairs(Map& map, std::size_t most_blocks) {
  int num_merged = 0;
  for (std::size_t num_blocks = 0; num_blocks < most_blocks;) {
    const auto pairs = map.info().pairs.pairs();
    const auto pair =
        std::find_if(pairs.begin(), pairs.end(), [&map](const ObjectPair& p) { return ShouldMerge(p, map); });
    if (pair == pairs.end()) break;
    const auto [first, second] = std::pair(pair->first, pair->second);
    num_blocks += map.Find(second)->blocks().size() + 1;
    MergeSubmaps(second, first, map);
    ++num_merged;
  }
  return num_merged;
}

int DissolveRemnants(Map& map) {
  std::vector<SubmapId> remnants;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    const bool is_settled = info.panoptic == Panoptic::kThing && info.activity == Activity::kInactive;
    if (!is_settled || submap->IsAbsent() || IsEdited(info) || info.track_id != 0) continue;
    if (!HasSurfaceVoxels(*submap, kLeastSurfaceVoxels)) remnants.push_back(info.id);
  }
  return static_cast<int>(
      std::count_if(remnants.begin(), remnants.end(), [&map](SubmapId id) { return DissolveIntoUnknown(id, map); }));
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/presence.h"

#include <cmath>
#include <vector>

namespace dhpmap {
namespace {

bool HasGone(const Submap& submap) {
  for (const BlockEntry& entry : submap.blocks().entries()) {
    if (entry.gone != nullptr) return true;
  }
  return false;
}

void LeaveIfGone(SubmapId id, Map& map) {
  const Submap* submap = map.Find(id);
  if (submap == nullptr || submap->IsAbsent()) return;
  const SubmapInfo& info = submap->info();
  const bool is_settled = info.panoptic == Panoptic::kThing && info.activity == Activity::kInactive;
  if (!is_settled || info.is_placed || info.is_locked) return;
  if (!HasGone(*submap)) return;
  const SurfaceVoxels voxels = CountSurfaceVoxels(*submap);
  const auto all = static_cast<double>(voxels.all);
  const bool is_most_gone = static_cast<double>(voxels.contradicted) > kAbsentShare * all;
  if (!is_most_gone && static_cast<double>(voxels.doubted_unseen) <= kAbsentShareUnseen * all) return;
  map.FindMutable(id)->mutable_info().presence = Presence::kAbsent;
}

}  // namespace

SurfaceVoxels CountSurfaceVoxels(const Submap& submap) {
  const auto near_m = static_cast<float>(submap.info().voxel_size_m);
  SurfaceVoxels voxels;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    const bool is_unseen = entry.gone != nullptr && entry.gone->last().stamp_ns > submap.info().last_observed_ns;
    for (int linear = 0; entry.tsdf != nullptr && linear < kBlockVoxels; ++linear) {
      if (!entry.tsdf->IsObserved(linear)) continue;
      if (std::abs(entry.tsdf->distance_m[static_cast<std::size_t>(linear)]) >= near_m) continue;
      ++voxels.all;
      voxels.contradicted += entry.IsContradicted(linear);
      voxels.doubted_unseen += is_unseen && entry.gone->Count(linear) >= 2;
    }
  }
  return voxels;
}

void UpdatePresence(const PanopticFrame& frame, std::span<const SubmapId> observed, std::span<const SubmapId> doubted,
                    Map& map) {
  for (const SubmapId id : observed) {
    const Submap* submap = map.Find(id);
    if (submap == nullptr || !submap->IsAbsent() || submap->info().is_locked) continue;
    Submap& back = *map.FindMutable(id);
    back.mutable_info().presence = Presence::kPresent;
    if (!frame.has_persistent_ids) back.DropGone();
  }
  for (const SubmapId id : doubted) LeaveIfGone(id, map);
}

void UpdatePresenceOfAll(Map& map) {
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) ids.push_back(submap->id());
  for (const SubmapId id : ids) LeaveIfGone(id, map);
}

}  // namespace dhpmap

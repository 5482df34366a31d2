// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/space/presence.h"

#include <cmath>
#include <vector>

#include "mapping/space/leaving_parts.h"

namespace dhpmap {
namespace {

/// Adds the counts of the block's voxels.
void AddVoxelsOf(const BlockEntry& entry, const SubmapInfo& info, SurfaceVoxels& voxels) {
  if (entry.tsdf == nullptr) return;
  const auto near_m = static_cast<float>(info.voxel_size_m);
  const bool is_unseen = entry.gone != nullptr && entry.gone->last().stamp_ns > info.last_observed_ns;
  const bool is_settled = entry.gone != nullptr && entry.gone->last().stamp_ns < info.last_observed_ns;
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (!entry.tsdf->IsObserved(linear)) continue;
    if (std::abs(entry.tsdf->distance_m[static_cast<std::size_t>(linear)]) >= near_m) continue;
    ++voxels.all;
    voxels.contradicted += entry.IsContradicted(linear);
    voxels.doubted += entry.gone != nullptr && entry.gone->Count(linear) >= 2;
    voxels.settled += is_settled && entry.IsContradicted(linear);
    voxels.doubted_unseen += is_unseen && entry.gone->Count(linear) >= 2;
  }
}

/// Fewer doubted voxels than in one counted block: neither a part nor a thing.
constexpr std::int64_t kLeastDoubted = 8;

bool IsMostGone(const SurfaceVoxels& voxels) {
  const auto all = static_cast<double>(voxels.all), settled = static_cast<double>(voxels.settled);
  const auto contradicted = static_cast<double>(voxels.contradicted);
  if (settled > kMovedShare * all) return contradicted - settled > kAbsentShare * (all - settled);
  return contradicted > kAbsentShare * all || static_cast<double>(voxels.doubted_unseen) > kAbsentShareUnseen * all;
}

/// Counts only blocks with gone counts. Other blocks can only add to the surface that is present.
SurfaceVoxels CountDoubtedBlocks(const Submap& submap) {
  SurfaceVoxels voxels;
  for (const TileEntry& tile : submap.blocks().tiles()) {
    if (!tile.tile->IsRead() && tile.tile->CellsWith(BlockLayer::kGone) == 0) continue;  // known without reading
    for (const BlockEntry& entry : tile.tile->entries()) {
      if (entry.gone != nullptr) AddVoxelsOf(entry, submap.info(), voxels);
    }
  }
  return voxels;
}

SurfaceVoxels CountIn(const std::vector<SurfacePart>& parts, const Submap& submap) {
  SurfaceVoxels voxels;
  for (const SurfacePart& part : parts) {
    for (const BlockIndex block : part.blocks) AddVoxelsOf(*submap.blocks().Find(block), submap.info(), voxels);
  }
  return voxels;
}

void LeaveIfGone(SubmapId id, Map& map) {
  const Submap* submap = map.Find(id);
  if (submap == nullptr || submap->IsAbsent()) return;
  const SubmapInfo& info = submap->info();
  const bool is_settled = info.panoptic == Panoptic::kThing && info.activity == Activity::kInactive;
  if (!is_settled || info.is_placed || info.is_locked) return;
  if (CountDoubtedBlocks(*submap).doubted < kLeastDoubted) return;
  const std::vector<SurfacePart> staying = LetPartsLeave(id, map);
  if (!IsMostGone(CountIn(staying, *map.Find(id)))) return;
  map.FindMutable(id)->mutable_info().presence = Presence::kAbsent;
}

}  // namespace

SurfaceVoxels CountSurfaceVoxels(const Submap& submap) {
  SurfaceVoxels voxels;
  for (const BlockEntry& entry : submap.blocks().entries()) AddVoxelsOf(entry, submap.info(), voxels);
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

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/activity.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "mapping/map/kept_clear.h"
#include "mapping/map/map_grid.h"
#include "mapping/map/region.h"
#include "mapping/tracking/visibility.h"
#include "mapping/voxels/voxel_average.h"

namespace dhpmap {
namespace {

/// The effect of a frame in which a thing was not observed.
struct Miss {
  bool counts = false;          ///< its session had the thing in view, or no session had
  bool was_overlooked = false;  ///< unconfirmed, and should have been observed
  bool is_deserted = false;     ///< the sessions that had it in view no longer send frames
  bool is_kept_clear = false;   ///< in an ignored region, where points are left out: it stays
};

bool LiesWithin(const KeptClear& kept_clear, const BoundingSphere& sphere) {
  const auto& regions = kept_clear.list();
  return std::any_of(regions.begin(), regions.end(),
                     [&](const KeptClearRegion& region) { return Contains(region.region, sphere.center_m); });
}

Miss MissOf(const PanopticFrame& frame, FrameSight& sight, std::int64_t number, const Submap& submap,
            const MapInfo& map) {
  const SubmapInfo& info = submap.info();
  const BoundingSphere sphere = submap.BoundingSphereInMap();
  const bool is_kept_clear = LiesWithin(map.kept_clear, sphere);
  const bool is_active = info.activity == Activity::kActive;
  return {.counts = is_active && (info.sightings.IsInSightOf(frame.session) || !info.sightings.IsInSight()),
          .was_overlooked = !info.is_confirmed && !is_kept_clear && sight.ShouldBeSeen(sphere),
          .is_deserted = is_active && info.sightings.IsDeserted(number, kMaxSilentFrames),
          .is_kept_clear = is_kept_clear};
}

void NoteMiss(const PanopticFrame& frame, std::int64_t number, const Miss& miss, std::int32_t max_missed,
              SubmapInfo& info) {
  info.num_frames_overlooked += miss.was_overlooked;
  if (!info.sightings.IsInSight()) {
    ++info.num_frames_missed;
    if (info.num_frames_missed >= max_missed) info.activity = Activity::kInactive;
    return;
  }
  info.sightings.OnMissed(frame.session, number);
  info.num_frames_missed = info.sightings.LeastMissed();
  info.sightings.Lapse(max_missed, number, kMaxSilentFrames);
  if (!info.sightings.IsInSight()) info.activity = Activity::kInactive;
}

/// Contradicted voxels are merged only into empty ones, and replaced by others.
void MergeBlock(const BlockEntry& from, Submap& submap, float max_weight) {
  TsdfBlock& into = submap.MutableTsdf(from.index);
  const std::shared_ptr<const GoneBlock> known = submap.blocks().Find(from.index)->gone;
  GoneBlock gone = known != nullptr ? *known : GoneBlock();
  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    if (!from.tsdf->IsObserved(linear)) continue;
    const auto i = static_cast<std::size_t>(linear);
    const bool is_contradicted = from.IsContradicted(linear);
    if (is_contradicted && into.IsObserved(linear)) continue;
    if (is_contradicted || gone.IsContradicted(linear)) {
      into.weight[i] = 0;
      gone.Set(linear, from.gone != nullptr ? from.gone->Count(linear) : 0);
    }
    MergedAverage<float> merged;
    merged.Add(into, i);
    merged.Add(*from.tsdf, i);
    merged.Store(into, i);
    into.weight[i] = std::min(into.weight[i], max_weight);
  }
  if (known != nullptr ? gone == *known : gone.empty()) return;
  submap.PutGone(from.index, gone.empty() ? nullptr : std::make_shared<const GoneBlock>(gone));
}

}  // namespace

int UpdateActivity(const PanopticFrame& frame, const std::vector<SubmapId>& observed, Map& map) {
  const MapConfig& config = map.info().config;
  const std::int32_t max_missed = config.activity.deactivate_after_missed;
  const std::int64_t number = map.info().num_frames + 1;
  std::vector<SubmapId> things;
  for (const auto& submap : map.submaps()) {
    if (submap->info().panoptic == Panoptic::kThing) things.push_back(submap->id());
  }
  FrameSight sight(frame, config.integration.max_range_m);
  int num_dissolved = 0;
  for (const SubmapId id : things) {
    const SubmapInfo& before = map.Find(id)->info();
    if (before.is_locked) continue;
    if (std::find(observed.begin(), observed.end(), id) != observed.end()) {
      SubmapInfo& info = map.FindMutable(id)->mutable_info();
      info.activity = Activity::kActive;
      info.num_frames_missed = info.num_frames_overlooked = 0;
      info.sightings.OnSeen(frame.session, number);
      if (info.num_frames_observed > config.activity.required_reobservations) info.is_confirmed = true;
      continue;
    }
    const bool is_sure = before.is_confirmed || IsEdited(before);
    if (before.activity == Activity::kInactive && is_sure) continue;  // inactive: do not write to its row
    const Miss miss = MissOf(frame, sight, number, *map.Find(id), map.info());
    if (!miss.counts && !miss.was_overlooked && !miss.is_deserted) continue;
    SubmapInfo& info = map.FindMutable(id)->mutable_info();
    NoteMiss(frame, number, miss, max_missed, info);
    const bool is_refuted = info.activity == Activity::kInactive && info.num_frames_overlooked >= max_missed &&
                            !miss.is_kept_clear && !IsEdited(info);  // may have been overlooked before
    if (is_refuted && DissolveIntoUnknown(id, map)) ++num_dissolved;
  }
  return num_dissolved;
}

bool DissolveIntoUnknown(SubmapId id, Map& map) {
  const Submap* submap = map.Find(id);
  if (submap == nullptr || id == kUnknownSubmap || !IsExclusive(submap->info(), map.info().config)) {
    return false;
  }
  Submap& unknown = *map.FindMutable(kUnknownSubmap);
  const auto max_weight = static_cast<float>(map.info().config.integration.max_weight);
  for (const BlockEntry& entry : submap->blocks().entries()) {
    if (entry.tsdf) MergeBlock(entry, unknown, max_weight);
  }
  unknown.UpdateBoundingSphere();
  return map.Remove(id);
}

void DeactivateAll(Map& map) {
  std::vector<SubmapId> active;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    if (info.panoptic == Panoptic::kThing && info.activity == Activity::kActive && !info.is_locked) {
      active.push_back(submap->id());
    }
  }
  for (const SubmapId id : active) {
    SubmapInfo& info = map.FindMutable(id)->mutable_info();
    info.activity = Activity::kInactive;
    info.sightings.LapseAll();
  }
}

}  // namespace dhpmap

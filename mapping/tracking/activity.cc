// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/activity.h"

#include <algorithm>
#include <cmath>

#include "mapping/map/map_grid.h"
#include "mapping/map/voxel_average.h"
#include "mapping/tracking/visibility.h"

namespace dhpmap {
namespace {

void MergeTsdf(const TsdfBlock& from, TsdfBlock& into, float max_weight) {
  for (std::size_t i = 0; i < kBlockVoxels; ++i) {
    if (from.weight[i] < kMinObservedWeight) continue;
    MergedAverage<float> merged;
    merged.Add(into, i);
    merged.Add(from, i);
    merged.Store(into, i);
    into.weight[i] = std::min(into.weight[i], max_weight);
  }
}

}  // namespace

int UpdateActivity(const PanopticFrame& frame, const std::vector<SubmapId>& observed, Map& map) {
  const MapConfig& config = map.info().config;
  std::vector<SubmapId> things;
  for (const auto& submap : map.submaps()) {
    if (submap->info().panoptic == Panoptic::kThing) things.push_back(submap->id());
  }
  int num_dissolved = 0;
  for (const SubmapId id : things) {
    const SubmapInfo& before = map.Find(id)->info();
    if (std::find(observed.begin(), observed.end(), id) != observed.end()) {
      SubmapInfo& info = map.FindMutable(id)->mutable_info();
      info.activity = Activity::kActive;
      info.num_frames_missed = info.num_frames_overlooked = 0;
      if (info.num_frames_observed > config.activity.required_reobservations) info.is_confirmed = true;
      continue;
    }
    if (before.activity == Activity::kInactive && before.is_confirmed) continue;  // settled: leave its row alone
    const bool was_overlooked = !before.is_confirmed && ShouldBeSeen(frame, config.integration.max_range_m,
                                                                     map.Find(id)->BoundingSphereInMap());
    if (before.activity == Activity::kInactive && !was_overlooked) continue;
    SubmapInfo& info = map.FindMutable(id)->mutable_info();
    ++info.num_frames_missed;
    if (was_overlooked) ++info.num_frames_overlooked;
    if (info.num_frames_missed >= config.activity.deactivate_after_missed) info.activity = Activity::kInactive;
    if (info.num_frames_overlooked >= config.activity.deactivate_after_missed && DissolveIntoUnknown(id, map)) {
      ++num_dissolved;
    }
  }
  return num_dissolved;
}

bool DissolveIntoUnknown(SubmapId id, Map& map) {
  const Submap* submap = map.Find(id);
  if (submap == nullptr || id == kUnknownSubmap || !IsOnMapGrid(submap->info(), map.info().config)) {
    return false;
  }
  Submap& unknown = *map.FindMutable(kUnknownSubmap);
  const auto max_weight = static_cast<float>(map.info().config.integration.max_weight);
  for (const BlockEntry& entry : submap->blocks().entries()) {
    if (entry.tsdf) MergeTsdf(*entry.tsdf, unknown.MutableTsdf(entry.index), max_weight);
  }
  unknown.UpdateBoundingSphere();
  return map.Remove(id);
}

void DeactivateAll(Map& map) {
  std::vector<SubmapId> active;
  for (const auto& submap : map.submaps()) {
    if (submap->info().panoptic == Panoptic::kThing && submap->info().activity == Activity::kActive) {
      active.push_back(submap->id());
    }
  }
  for (const SubmapId id : active) map.FindMutable(id)->mutable_info().activity = Activity::kInactive;
}

}  // namespace dhpmap

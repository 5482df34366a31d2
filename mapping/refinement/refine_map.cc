// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/refinement/refine_map.h"

#include <chrono>

#include "mapping/evidence/stray_voxels.h"
#include "mapping/evidence/submap_labels.h"
#include "mapping/map/map_grid.h"

namespace dhpmap {
namespace {

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void RestoreLabels(const std::vector<SubmapId>& ids, Map& map) {
  for (const SubmapId id : ids) {
    if (!IsExclusive(map.Find(id)->info(), map.info().config)) continue;
    for (const BlockEntry& entry : map.Find(id)->blocks().entries()) {
      if (id == kUnknownSubmap || !entry.tsdf || entry.labels) continue;
      RestoreDroppedLabels(*map.FindMutable(id));
      break;
    }
  }
}

}  // namespace

RefinementReport& RefinementReport::operator+=(const RefinementReport& other) {
  management.num_shared_voxels += other.management.num_shared_voxels;
  management.num_moved_voxels += other.management.num_moved_voxels;
  management.num_removed_submaps += other.management.num_removed_submaps;
  management.num_skipped_submaps += other.management.num_skipped_submaps;
  crf.num_voxels += other.crf.num_voxels;
  crf.num_changed_classes += other.crf.num_changed_classes;
  crf.num_changed_instances += other.crf.num_changed_instances;
  crf.num_tiles += other.crf.num_tiles;
  management_s += other.management_s;
  crf_s += other.crf_s;
  num_stray_voxels += other.num_stray_voxels;
  num_bytes_dropped += other.num_bytes_dropped;
  num_deferred_blocks += other.num_deferred_blocks;
  return *this;
}

bool IsSettled(const SubmapInfo& info) {
  if (info.presence == Presence::kAbsent || info.is_locked) return false;
  return info.panoptic != Panoptic::kThing || info.activity == Activity::kInactive;
}

bool IsRefined(const SubmapInfo& info, const MapConfig& config) { return IsSettled(info) && IsExclusive(info, config); }

std::vector<SubmapId> SettledSubmaps(const Map& map) {
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) {
    if (IsSettled(submap->info())) ids.push_back(submap->id());
  }
  return ids;
}

RefinementReport RefineRegion(Map& map, ThreadPool& pool, const RefinementRegion* region,
                              const std::function<bool()>& is_cancelled) {
  RefinementReport report;
  const RefinementConfig& config = map.info().config.refinement;
  const std::vector<SubmapId> ids = SettledSubmaps(map);
  if (config.management) {
    const auto start = std::chrono::steady_clock::now();
    RestoreLabels(ids, map);
    report.management = ManageLabels(ids, map, pool, region, RimOfLabels(map.info().config));
    report.management_s = SecondsSince(start);
  }
  if (config.crf && !(is_cancelled && is_cancelled())) {
    const auto start = std::chrono::steady_clock::now();
    report.crf = RefineLabels(ids, map, pool, region, is_cancelled);
    report.crf_s = SecondsSince(start);
  }
  return report;
}

RefinementReport RefineStrayVoxels(Map& map, ThreadPool& pool) {
  RefinementReport report;
  if (!map.info().config.refinement.management) return report;
  const auto start = std::chrono::steady_clock::now();
  report.num_stray_voxels = AbsorbStrayVoxels(SettledSubmaps(map), map, pool);
  report.management_s = SecondsSince(start);
  return report;
}

RefinementReport RefineMap(Map& map, ThreadPool& pool, const RefinementRegion* region,
                           const std::function<bool()>& is_cancelled) {
  RefinementReport report = RefineRegion(map, pool, region, is_cancelled);
  if (!(is_cancelled && is_cancelled())) report += RefineStrayVoxels(map, pool);
  return report;
}

std::int64_t DropVoxelLabels(Map& map) {
  std::int64_t num_bytes = 0;
  std::vector<SubmapId> labelled;
  for (const auto& submap : map.submaps()) {
    if (submap->info().is_locked || !IsExclusive(submap->info(), map.info().config)) continue;
    std::int64_t own_bytes = 0;
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (entry.labels) own_bytes += static_cast<std::int64_t>(entry.labels->MemoryBytes());
    }
    if (own_bytes > 0) labelled.push_back(submap->id());
    num_bytes += own_bytes;
  }
  for (const SubmapId id : labelled) map.FindMutable(id)->DropLabels();
  return num_bytes;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/frame_fusion.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "mapping/base/largest_first.h"
#include "mapping/fusion/bundler.h"
#include "mapping/fusion/integrator.h"
#include "mapping/fusion/kept_clear_voxels.h"
#include "mapping/map/map_grid.h"
#include "mapping/pipeline/assigned_parts.h"

namespace dhpmap {
namespace {

/// The segments of a frame that are fused into one submap, in the order of the table.
struct SubmapWork {
  Submap* submap;
  std::vector<std::size_t> segments;
  std::int64_t num_updates = 0;
};

std::vector<SubmapWork> GroupBySubmap(std::span<const Assignment> assignments, Map& map) {
  std::vector<SubmapWork> works;
  for (std::size_t s = 0; s < assignments.size(); ++s) {
    Submap* submap = map.FindMutable(assignments[s].submap);
    auto it = std::find_if(works.begin(), works.end(), [&](const SubmapWork& work) { return work.submap == submap; });
    if (it == works.end()) it = works.insert(works.end(), {submap, {}});
    it->segments.push_back(s);
  }
  return works;
}

/// The label of a row's segment in `submap`; nothing without a row or a class, and in the unknown submap.
std::optional<ClassId> LabelOf(const PanopticFrame& frame, int row, const SubmapInfo& submap) {
  if (row < 0 || submap.id == kUnknownSubmap) return std::nullopt;
  return frame.segments[static_cast<std::size_t>(row)].class_id;
}

/// Nothing without ignored regions. Refers to the map's regions.
std::optional<KeptClearVoxels> KeptClearVoxelsOf(const MapInfo& map, const SubmapInfo& submap) {
  if (map.kept_clear.empty()) return std::nullopt;
  return std::optional<KeptClearVoxels>(std::in_place, map.kept_clear, submap);
}

/// The number of bundles to trace for each submap; a submap with its own grid bundles the whole frame again.
std::vector<std::size_t> SizesOf(const std::vector<SubmapWork>& works, const std::vector<SegmentBundles>& segments,
                                 const MapConfig& config) {
  std::size_t of_frame = 0;
  for (const SegmentBundles& segment : segments) of_frame += segment.bundles.size();
  std::vector<std::size_t> sizes;
  sizes.reserve(works.size());
  for (const SubmapWork& work : works) {
    const SubmapInfo& info = work.submap->info();
    std::size_t size = 0;
    for (const std::size_t segment : work.segments) size += segments[segment].bundles.size();
    if (!IsOnMapGrid(info, config)) size += of_frame;
    sizes.push_back(info.is_locked ? 0 : size);
  }
  return sizes;
}

void FuseSubmap(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, const MapInfo& map,
                const std::stop_token& stop, SubmapWork& work, VoxelJournal& journal) {
  const MapConfig& map_config = map.config;
  Submap& submap = *work.submap;
  if (submap.info().is_locked) {
    submap.mutable_info().last_observed_ns = frame.stamp_ns;
    return;
  }
  const SubmapInfo& info = submap.info();
  const IntegrationConfig& config = map_config.integration;
  const bool on_map_grid = IsOnMapGrid(info, map_config);
  const Transform T_submap_sensor = info.T_map_submap.inverse() * frame.T_map_sensor;
  const RayOrigin origin(T_submap_sensor.translation(), info.voxel_size_m);
  const std::size_t num_blocks = submap.blocks().size();

  // A moved object has its own grid: bundle the frame again on that grid, without points assigned to other submaps.
  ThreadPool here(1);
  Bundler own_bundler(config, here);
  const std::vector<SegmentBundles>* bundled = nullptr;
  if (!on_map_grid) {
    const auto rest = WithoutPartsOfOthers(frame, segments, work.segments, map_config.voxel_size_m);
    bundled = &own_bundler.BundleFrame(rest ? *rest : frame, T_submap_sensor, info.voxel_size_m);
  }

  std::optional<KeptClearVoxels> kept_clear = KeptClearVoxelsOf(map, info);
  int last_row = -2;
  for (const std::size_t s : work.segments) {
    const int row = segments[s].row;
    const SegmentBundles* bundles = &segments[s];
    if (!on_map_grid) {
      if (std::exchange(last_row, row) == row) continue;  // another part of the same segment
      const auto own = std::find_if(bundled->begin(), bundled->end(), [row](const auto& b) { return b.row == row; });
      if (own == bundled->end()) continue;  // a point or two on the face of another's voxel
      bundles = &*own;
    }
    work.num_updates += IntegrateSegment(*bundles, origin, LabelOf(frame, row, info), config, submap, stop,
                                         kept_clear ? &*kept_clear : nullptr, &journal);
  }
  if (submap.blocks().size() != num_blocks) submap.UpdateBoundingSphere();
  submap.mutable_info().num_frames_observed += 1;
  submap.mutable_info().last_observed_ns = frame.stamp_ns;
}

}  // namespace

std::int64_t FuseFrame(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                       std::span<const Assignment> assignments, Map& map, ThreadPool& pool, FrameJournal& journal,
                       const std::stop_token& stop) {
  std::vector<SubmapWork> works = GroupBySubmap(assignments, map);
  const MapConfig& config = map.info().config;
  const std::vector<std::size_t> by_size = LargestFirst(SizesOf(works, segments, config));
  const std::span<VoxelJournal> journals = journal.OfSubmaps(works.size());
  pool.ParallelFor(works.size(), [&](std::size_t i) {
    FuseSubmap(frame, segments, map.info(), stop, works[by_size[i]], journals[i]);
  });
  std::int64_t num_updates = 0;
  for (const SubmapWork& work : works) num_updates += work.num_updates;
  return num_updates;
}

}  // namespace dhpmap

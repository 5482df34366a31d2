// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>

#include "mapping/fusion/kept_clear_points.h"
#include "mapping/pipeline/map_builder.h"
#include "mapping/space/presence.h"
#include "tests/bench/bench.h"
#include "tests/bench/frames.h"

namespace dhpmap::bench {
namespace {

constexpr ClassId kOneClass{1};

/// Every pixel or point becomes one segment of one background class.
void LabelAsOne(PanopticFrame& frame) {
  const SegmentId all(1);
  frame.segments = {{.id = all, .class_id = kOneClass}};
  if (frame.camera) frame.camera->segments.assign(frame.camera->depth_m.size(), all.value);
  if (frame.lidar) frame.lidar->segments.assign(frame.lidar->points_m.size(), all.value);
}

Result<MapInfo> MakeInfo(const FusionBenchOptions& options, const Dataset& dataset) {
  MapInfo info;
  info.name = "bench";
  DHPMAP_RETURN_IF_ERROR(ApplyPreset(dataset.preset(), info.config));
  info.config.voxel_size_m = options.voxel_size_m;
  info.config.truncation_m = options.truncation_m;
  info.config.integration.max_range_m = options.max_range_m;
  info.config.space.free = options.free_space;
  info.config.space.gone = options.gone;
  DHPMAP_RETURN_IF_ERROR(info.config.Validate());
  std::vector<LabelClass> classes = dataset.label_classes();
  if (options.labels == "one") classes = {{.id = kOneClass, .name = "everything", .panoptic = Panoptic::kStuff}};
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(std::move(classes)));
  info.label_set = std::make_shared<LabelSet>(std::move(label_set));
  return info;
}

/// Half way to what the middle of a frame sees, of frames all along the way.
Status KeepClearAlong(const std::vector<PanopticFrame>& frames, std::size_t count, KeptClear& kept_clear) {
  for (std::size_t n = 0; n < count; ++n) {
    const PanopticFrame& frame = frames[n * frames.size() / count];
    Eigen::Vector3d p_m(3, 0, 0);
    if (frame.camera) {
      const PinholeCamera& camera = frame.camera->camera;
      const auto middle = static_cast<std::size_t>(camera.height_px / 2 * camera.width_px + camera.width_px / 2);
      p_m = {0, 0, 0.5 * static_cast<double>(frame.camera->depth_m[middle])};
    }
    const BoundingSphere sphere{frame.T_map_sensor * p_m, 0.3};
    DHPMAP_RETURN_IF_ERROR(kept_clear.Add({"region-" + std::to_string(n), sphere}));
  }
  return Status::Ok();
}

/// What it takes to leave out points of regions that are kept clear, alone.
void PrintCutting(const std::vector<PanopticFrame>& frames, const KeptClear& kept_clear) {
  if (kept_clear.empty()) return;
  std::size_t num_changed = 0;
  const std::clock_t cpu_before = std::clock();
  for (const PanopticFrame& frame : frames) num_changed += WithoutKeptClear(frame, kept_clear).has_value();
  const auto cpu_s = static_cast<double>(std::clock() - cpu_before) / CLOCKS_PER_SEC;
  std::printf("kept clear: %.3f ms a frame to cut points out, of %zu of %zu frames\n",
              1e3 * cpu_s / static_cast<double>(frames.size()), num_changed, frames.size());
}

/// What the map takes for gone, which is wrong where nothing has moved.
void PrintGone(const Map& map) {
  SurfaceVoxels sum;
  std::size_t num_blocks = 0, bytes = 0, num_absent = 0;
  for (const auto& submap : map.submaps()) {
    const SurfaceVoxels voxels = CountSurfaceVoxels(*submap);
    sum.all += voxels.all;
    sum.contradicted += voxels.contradicted;
    num_absent += submap->IsAbsent();
    for (const BlockEntry& entry : submap->blocks().entries()) {
      if (entry.gone == nullptr) continue;
      ++num_blocks;
      bytes += entry.gone->MemoryBytes();
    }
  }
  std::printf("gone: %lld of %lld surface voxels (%.4f %%), %zu submaps absent, %zu blocks, %.1f KB\n",
              static_cast<long long>(sum.contradicted), static_cast<long long>(sum.all),
              100.0 * static_cast<double>(sum.contradicted) / static_cast<double>(std::max<std::int64_t>(1, sum.all)),
              num_absent, num_blocks, static_cast<double>(bytes) / 1e3);
}

void PrintSize(const Map& map) {
  std::size_t num_blocks = 0, num_observed = 0, bytes = 0;
  for (const auto& submap : map.submaps()) {
    num_blocks += submap->blocks().size();
    bytes += submap->MemoryBytes();
    for (const BlockEntry& entry : submap->blocks().entries()) {
      num_observed += static_cast<std::size_t>(entry.tsdf->NumObservedVoxels());
    }
  }
  const double num_voxels = static_cast<double>(num_blocks) * kBlockVoxels;
  const FreeSpace& space = map.free_space();
  const auto num_free = static_cast<double>(space.NumFreeVoxels());
  std::printf("free space: %zu tiles, %.0f voxels, %.0f m3, %.1f KB, %.2f bits a voxel\n", space.tiles().size(),
              num_free, num_free * std::pow(map.info().config.voxel_size_m, 3),
              static_cast<double>(space.MemoryBytes()) / 1e3,
              8.0 * static_cast<double>(space.MemoryBytes()) / num_free);
  std::printf("map: %zu submaps, %zu blocks, %.0f voxels, %zu observed (%.1f %%), %.1f MB, %.2f bytes a voxel\n",
              map.submaps().size(), num_blocks, num_voxels, num_observed,
              100.0 * static_cast<double>(num_observed) / num_voxels, static_cast<double>(bytes) / 1e6,
              static_cast<double>(bytes) / num_voxels);
}

}  // namespace

Status RunFusionBench(const FusionBenchOptions& options) {
  const LabelSource labels = options.labels == "groundtruth" ? LabelSource::kGroundTruth
                             : options.labels == "predicted" ? LabelSource::kPredicted
                                                             : LabelSource::kNone;
  DHPMAP_ASSIGN_OR_RETURN(LoadedFrames loaded, LoadFrames(options.directory, labels, options.num_frames));
  if (options.labels == "one") {
    for (PanopticFrame& frame : loaded.frames) LabelAsOne(frame);
  }
  DHPMAP_ASSIGN_OR_RETURN(MapInfo info, MakeInfo(options, *loaded.dataset));
  DHPMAP_RETURN_IF_ERROR(KeepClearAlong(loaded.frames, options.num_kept_clear, info.kept_clear));

  std::printf("%zu frames (%zu skipped), voxel %g m, truncation %g m, labels %s, %d thread(s)\n", loaded.frames.size(),
              loaded.num_skipped, options.voxel_size_m, options.truncation_m, options.labels.c_str(),
              options.num_threads);
  std::printf(
      "ms a frame:    mean  median     p95 | bundle   track    fuse activity | free: mean  median     p95 | points  "
      "voxel updates\n");
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
    const std::clock_t cpu_before = std::clock();
    MapBuilder builder(info, options.num_threads);
    std::vector<double> times_ms, free_ms, refine_ms;
    FrameReport sum;
    for (const PanopticFrame& frame : loaded.frames) {
      const auto start = std::chrono::steady_clock::now();
      DHPMAP_ASSIGN_OR_RETURN(const FrameReport report, builder.Integrate(frame));
      times_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
      sum.bundle_s += report.bundle_s;
      sum.track_s += report.track_s;
      sum.fuse_s += report.fuse_s;
      sum.activity_s += report.activity_s;
      free_ms.push_back(1e3 * report.free_s);
      if (report.refinement) refine_ms.push_back(1e3 * report.refine_s);
      sum.num_points += report.num_points;
      sum.num_voxels_updated += report.num_voxels_updated;
    }
    const Summary total = Summarize(times_ms), free = Summarize(free_ms);
    const auto n = static_cast<double>(times_ms.size());
    std::printf("run %d       %7.2f %7.2f %7.2f | %6.2f  %6.2f  %6.2f   %6.2f |     %7.2f %7.2f %7.2f | %.0f  %.0f\n",
                repetition + 1, total.mean, total.median, total.p95, 1e3 * sum.bundle_s / n, 1e3 * sum.track_s / n,
                1e3 * sum.fuse_s / n, 1e3 * sum.activity_s / n, free.mean, free.median, free.p95,
                static_cast<double>(sum.num_points) / n, static_cast<double>(sum.num_voxels_updated) / n);
    const auto cpu_s = static_cast<double>(std::clock() - cpu_before) / CLOCKS_PER_SEC;
    std::printf("            %.2f ms a frame of all cores together", 1e3 * cpu_s / n);
    if (!refine_ms.empty()) {
      const Summary refine = Summarize(refine_ms);
      std::printf("; %zu waited for a refinement, ms: mean %.2f, median %.2f, p95 %.2f", refine_ms.size(), refine.mean,
                  refine.median, refine.p95);
    }
    std::printf("\n");
    if (repetition + 1 != options.repetitions) continue;
    PrintCutting(loaded.frames, info.kept_clear);
    PrintGone(builder.map());
    PrintSize(builder.map());
  }
  return Status::Ok();
}

}  // namespace dhpmap::bench

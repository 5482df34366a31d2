// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/map_builder.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "mapping/base/thread_pool.h"
#include "mapping/fusion/bundler.h"
#include "mapping/fusion/integrator.h"
#include "mapping/fusion/segment_parts.h"
#include "mapping/map/map_grid.h"
#include "mapping/pipeline/background_refinement.h"
#include "mapping/tracking/activity.h"
#include "mapping/tracking/tracker.h"
#include "mapping/tracking/visibility.h"

namespace dhpmap {
namespace {

class Stopwatch {
 public:
  /// Seconds since construction or the last lap.
  double Lap_s() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Which rows of the frame's table are things.
std::vector<bool> ThingRows(const PanopticFrame& frame, const LabelSet& label_set) {
  std::vector<bool> is_thing;
  for (const SegmentInfo& segment : frame.segments) {
    is_thing.push_back(segment.class_id && label_set.Find(*segment.class_id)->panoptic == Panoptic::kThing);
  }
  return is_thing;
}

/// The segments of a frame that go into one submap, in the order of the table.
struct SubmapWork {
  Submap* submap;
  std::vector<std::size_t> segments;
  std::int64_t num_updates = 0;
};

}  // namespace

struct MapBuilder::Impl {
  Impl(Map m, int num_threads, RefinementTiming t)
      : map(std::move(m)),
        pool(num_threads),
        timing(t),
        bundler(map.info().config.integration, pool),
        tracker(map.info().config, pool) {}

  std::vector<SubmapWork> GroupBySubmap(const std::vector<Assignment>& assignments);
  void Fuse(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, SubmapWork& work);
  std::int64_t Carve(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments);
  std::optional<RefinementReport> RefineOnTheSide();
  RefinementReport TakeOver(const BackgroundRefinement::Outcome& outcome);
  void PruneEmptyBlocks();

  Map map;
  ThreadPool pool;
  RefinementTiming timing;
  Bundler bundler;
  Tracker tracker;
  BackgroundRefinement refinement;
  bool is_overdue = false;                          // the refinement under way should be taken over
  std::shared_ptr<const MapSnapshot> last_refined;  // in this session
  RefinementReport refinement_total;
};

std::vector<SubmapWork> MapBuilder::Impl::GroupBySubmap(const std::vector<Assignment>& assignments) {
  std::vector<SubmapWork> works;
  for (std::size_t s = 0; s < assignments.size(); ++s) {
    Submap* submap = map.FindMutable(assignments[s].submap);
    auto it = std::find_if(works.begin(), works.end(), [&](const SubmapWork& work) { return work.submap == submap; });
    if (it == works.end()) it = works.insert(works.end(), {submap, {}});
    it->segments.push_back(s);
  }
  return works;
}

void MapBuilder::Impl::Fuse(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, SubmapWork& work) {
  Submap& submap = *work.submap;
  const SubmapInfo& info = submap.info();
  const IntegrationConfig& config = map.info().config.integration;
  const bool is_unknown = info.id == kUnknownSubmap;
  const bool on_map_grid = IsOnMapGrid(info, map.info().config);
  const Transform T_submap_sensor = info.T_map_submap.inverse() * frame.T_map_sensor;
  const RayOrigin origin(T_submap_sensor.translation(), info.voxel_size_m);
  const std::size_t num_blocks = submap.blocks().size();

  // A moved object has a grid of its own: bundle the frame again on that one, whole segments.
  ThreadPool here(1);
  Bundler own_bundler(config, here);
  const std::vector<SegmentBundles>* bundled = nullptr;
  if (!on_map_grid) bundled = &own_bundler.BundleFrame(frame, T_submap_sensor, info.voxel_size_m);

  int last_row = -2;
  for (const std::size_t s : work.segments) {
    const int row = segments[s].row;
    const SegmentBundles* bundles = &segments[s];
    if (!on_map_grid) {
      if (std::exchange(last_row, row) == row) continue;  // another part of the same segment
      bundles = &*std::find_if(bundled->begin(), bundled->end(), [row](const auto& b) { return b.row == row; });
    }
    std::optional<ClassId> class_id;
    if (!is_unknown) class_id = frame.segments[static_cast<std::size_t>(row)].class_id;
    work.num_updates += IntegrateSegment(*bundles, origin, class_id, config, submap);
  }
  if (submap.blocks().size() != num_blocks) submap.UpdateBoundingSphere();
  submap.mutable_info().num_frames_observed += 1;
  submap.mutable_info().last_observed_ns = frame.stamp_ns;
}

std::int64_t MapBuilder::Impl::Carve(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments) {
  const MapConfig& config = map.info().config;
  const RayOrigin origin(frame.T_map_sensor.translation(), config.voxel_size_m);
  std::vector<Submap*> in_view;
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) {
    if (IsOnMapGrid(submap->info(), config) &&
        MayBeInView(frame, config.integration.max_range_m, submap->bounding_sphere())) {
      ids.push_back(submap->id());
    }
  }
  for (const SubmapId id : ids) in_view.push_back(map.FindMutable(id));
  std::vector<std::int64_t> num_updates(in_view.size(), 0);
  pool.ParallelFor(in_view.size(), [&](std::size_t i) {
    num_updates[i] = CarveFreeSpace(segments, origin, config.integration, *in_view[i]);
  });
  std::int64_t total = 0;
  for (const std::int64_t n : num_updates) total += n;
  return total;
}

RefinementReport MapBuilder::Impl::TakeOver(const BackgroundRefinement::Outcome& outcome) {
  RefinementReport report = outcome.report;
  report.num_deferred_blocks = AdoptRefinement(*outcome.before, *outcome.refined, map);
  refinement_total += report;
  last_refined = outcome.refined;
  return report;
}

/// Turns come by the number of frames in the map, not in this session: so a map that was saved and loaded in between
/// is refined at the same frames. Returns what was taken over, if anything was.
std::optional<RefinementReport> MapBuilder::Impl::RefineOnTheSide() {
  const MapConfig& config = map.info().config;
  const RefinementConfig& refine = config.refinement;
  if (refine.every_frames == 0 || !(refine.management || refine.crf)) return std::nullopt;
  std::optional<RefinementReport> report;
  const bool is_turn = map.info().num_frames % refine.every_frames == 0;
  is_overdue = is_overdue || (is_turn && refinement.IsUnderWay());
  if (is_overdue && (timing == RefinementTiming::kReproducible || refinement.IsReady())) {
    if (const auto outcome = refinement.Take()) report = TakeOver(*outcome);
    is_overdue = false;
  }
  if (is_turn && !refinement.IsUnderWay()) refinement.Start(map.Freeze(), last_refined);
  return report;
}

void MapBuilder::Impl::PruneEmptyBlocks() {
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) {
    const auto entries = submap->blocks().entries();
    const bool has_empty_block = std::any_of(entries.begin(), entries.end(), [](const BlockEntry& entry) {
      return entry.tsdf == nullptr || !entry.tsdf->HasObservedVoxel();
    });
    if (has_empty_block) ids.push_back(submap->id());
  }
  for (const SubmapId id : ids) {
    Submap& submap = *map.FindMutable(id);
    submap.PruneBlocks();
    submap.UpdateBoundingSphere();
  }
}

MapBuilder::MapBuilder(MapInfo info, int num_threads, RefinementTiming timing)
    : impl_(std::make_unique<Impl>(Map(std::move(info)), num_threads, timing)) {}
MapBuilder::MapBuilder(std::shared_ptr<const MapSnapshot> snapshot, int num_threads, RefinementTiming timing)
    : impl_(std::make_unique<Impl>(Map(std::move(snapshot)), num_threads, timing)) {}
MapBuilder::~MapBuilder() = default;

Map& MapBuilder::map() { return impl_->map; }
const Map& MapBuilder::map() const { return impl_->map; }
const RefinementReport& MapBuilder::refinement_total() const { return impl_->refinement_total; }

Result<FrameReport> MapBuilder::Integrate(const PanopticFrame& frame) {
  Map& map = impl_->map;
  DHPMAP_RETURN_IF_ERROR(ValidateFrame(frame, *map.info().label_set));
  FrameReport report;
  Stopwatch watch;

  // (A) Points become bundles of segments on the map's grid.
  auto& segments = impl_->bundler.BundleFrame(frame, frame.T_map_sensor, map.info().config.voxel_size_m);
  const int gap_vox = map.info().config.tracking.split_gap_vox;
  if (gap_vox > 0 && !frame.has_persistent_ids) {
    SplitIntoParts(ThingRows(frame, *map.info().label_set), gap_vox, segments);
  }
  report.bundle_s = watch.Lap_s();

  // (B) Each segment finds its submap.
  const std::vector<Assignment> assignments = impl_->tracker.Assign(frame, segments, map);
  report.track_s = watch.Lap_s();

  // (C) Each submap takes its segments; submaps are independent of each other.
  std::vector<SubmapWork> works = impl_->GroupBySubmap(assignments);
  impl_->pool.ParallelFor(works.size(), [&](std::size_t i) { impl_->Fuse(frame, segments, works[i]); });
  if (map.info().config.integration.carving) report.num_voxels_updated += impl_->Carve(frame, segments);
  report.fuse_s = watch.Lap_s();

  // Things that were not seen for a while settle.
  std::vector<SubmapId> observed;
  for (const Assignment& assignment : assignments) observed.push_back(assignment.submap);
  report.num_dissolved = UpdateActivity(frame, observed, map);
  map.mutable_info().num_frames += 1;
  report.activity_s = watch.Lap_s();

  // (D) What has settled is refined on the side.
  report.refinement = impl_->RefineOnTheSide();
  report.refine_s = watch.Lap_s();

  for (std::size_t s = 0; s < segments.size(); ++s) {
    report.num_points += segments[s].num_points;
    if (assignments[s].submap == kUnknownSubmap) report.num_unknown_points += segments[s].num_points;
    if (segments[s].row >= 0) report.num_segments += 1;
    if (assignments[s].is_new) {
      report.num_created += 1;
    } else if (assignments[s].submap != kUnknownSubmap) {
      report.num_matched += 1;
    }
  }
  for (const SubmapWork& work : works) report.num_voxels_updated += work.num_updates;
  return report;
}

RefinementReport MapBuilder::Finish() {
  Map& map = impl_->map;
  impl_->refinement.Cancel();
  impl_->is_overdue = false;
  DeactivateAll(map);
  RefinementReport report = RefineMap(map, impl_->pool, impl_->last_refined.get());
  if (map.info().config.refinement.drop_voxel_labels && map.info().config.refinement.management) {
    report.num_bytes_dropped = DropVoxelLabels(map);
  }
  impl_->PruneEmptyBlocks();
  impl_->last_refined = map.Freeze();
  impl_->refinement_total += report;
  return report;
}

}  // namespace dhpmap

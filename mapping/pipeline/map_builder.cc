// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/pipeline/map_builder.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/free_memory.h"
#include "mapping/base/status_error.h"
#include "mapping/base/stopped.h"
#include "mapping/fusion/band_size.h"
#include "mapping/fusion/bundler.h"
#include "mapping/fusion/kept_clear_points.h"
#include "mapping/fusion/segment_parts.h"
#include "mapping/objects/apart_things.h"
#include "mapping/objects/object_care.h"
#include "mapping/objects/pair_evidence.h"
#include "mapping/paging/tile_page.h"
#include "mapping/pipeline/background_refinement.h"
#include "mapping/pipeline/frame_fusion.h"
#include "mapping/pipeline/stage_clock.h"
#include "mapping/pipeline/tiles_ahead.h"
#include "mapping/plausibility/frame_judge.h"
#include "mapping/sensor/frame_reach.h"
#include "mapping/sensor/hidden_things.h"
#include "mapping/space/free_space_finder.h"
#include "mapping/space/presence.h"
#include "mapping/tracking/activity.h"
#include "mapping/tracking/tracker.h"

namespace dhpmap {
namespace {

/// Blocks merged in one turn of refinement beyond one pair: each delays a frame by about 0.1 ms.
constexpr std::size_t kMergedBlocksATurn = 32;

/// Steps between two turns of refinement. With more, less of a state is kept for it, but frames wait more often for a
/// refinement to be adopted.
constexpr int kMostStepsARound = 8;

/// Which rows of the frame's table are things.
std::vector<bool> ThingRows(const PanopticFrame& frame, const LabelSet& label_set) {
  std::vector<bool> is_thing;
  for (const SegmentInfo& segment : frame.segments) {
    is_thing.push_back(segment.class_id && label_set.Find(*segment.class_id)->panoptic == Panoptic::kThing);
  }
  return is_thing;
}

}  // namespace

struct MapBuilder::Impl {
  Impl(Map m, std::shared_ptr<ThreadPool> p, RefinementTiming t, std::shared_ptr<RefinementSlots> s = nullptr)
      : map(std::move(m)),
        pool(std::move(p)),
        timing(t),
        slots(std::move(s)),
        bundler(map.info().config.integration, *pool),
        tracker(map.info().config, *pool),
        may_read_ahead(HasTilesOnDisk(map)) {}

  [[nodiscard]] Status CheckFrame(const PanopticFrame& frame) const;
  Result<FrameReport> IntegrateChecked(const PanopticFrame& frame, const std::stop_token& stop,
                                       ImplausibleFrames implausible);
  void GoBackTo(Map&& before);

  // The stages of a frame; each records its time and result in the report.
  const std::vector<SegmentBundles>& Bundle(const PanopticFrame& frame, FrameReport& report);
  [[nodiscard]] Status CheckSize(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments) const;
  [[nodiscard]] Status Judge(const PanopticFrame& frame, ImplausibleFrames implausible, FrameReport& report);
  std::vector<Assignment> Associate(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                    FrameReport& report);
  void Fuse(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
            const std::vector<Assignment>& assignments, const std::stop_token& stop, FrameReport& report);
  std::vector<SubmapId> LookThrough(const PanopticFrame& frame, const std::stop_token& stop, FrameReport& report);
  void Settle(const PanopticFrame& frame, const std::vector<Assignment>& assignments,
              std::vector<SubmapId> contradicted, FrameReport& report);
  void Refine(FrameReport& report);

  void CareForObjects(FrameReport& report);
  std::optional<RefinementReport> RefineOnTheSide(FrameReport& frame_report);
  RefinementReport TakeOver(const BackgroundRefinement::Outcome& outcome);
  void PruneEmptyBlocks();
  std::optional<RefinementReport> Finish(const std::function<bool()>& is_cancelled);

  Map map;
  std::shared_ptr<ThreadPool> pool;
  RefinementTiming timing;
  std::shared_ptr<RefinementSlots> slots;  // may be null
  Bundler bundler;
  FrameJournal journal;  // of the frame under way
  FrameJudge judge;
  FrameCheck check;  // of the last frame
  Tracker tracker;
  FreeSpaceFinder space;
  const bool may_read_ahead;  // some of the map was on disk at the start; later some of any map may be
  BackgroundRefinement refinement;
  RefinementRound round;    // of this session, as far as it was adopted
  bool is_overdue = false;  // the running refinement should be adopted
  bool is_waiting = false;  // for a slot
  RefinementReport refinement_total;
};

/// Checks that need no change of state.
Status MapBuilder::Impl::CheckFrame(const PanopticFrame& frame) const {
  DHPMAP_RETURN_IF_ERROR(ValidateFrame(frame, *map.info().label_set));
  return CheckFrameIsOnGrid(frame, map.info().config.voxel_size_m);
}

/// Points become segments: bundles on the map's grid. Things that are apart, or that an edit has split, become parts.
const std::vector<SegmentBundles>& MapBuilder::Impl::Bundle(const PanopticFrame& frame, FrameReport& report) {
  const StageClock clock(report.bundle_s);
  const MapInfo& info = map.info();
  auto& segments = bundler.BundleFrame(frame, frame.T_map_sensor, info.config.voxel_size_m);
  const int gap_vox = info.config.tracking.split_gap_vox;
  if (gap_vox > 0 && !frame.has_persistent_ids) SplitIntoParts(ThingRows(frame, *info.label_set), gap_vox, segments);
  tracker.CutAtSplits(frame, map, segments);
  for (const SegmentBundles& segment : segments) {
    report.num_points += segment.num_points;
    report.num_segments += segment.row >= 0;
  }
  return segments;
}

/// Checks the blocks that a frame may allocate, before it does.
Status MapBuilder::Impl::CheckSize(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments) const {
  const MapConfig& config = map.info().config;
  const RayOrigin origin(frame.T_map_sensor.translation(), config.voxel_size_m);
  const std::size_t num_blocks =
      CountBandBlocks(segments, origin, config.voxel_size_m, config.truncation_m, kMaxBlocksAFrame);
  if (num_blocks <= kMaxBlocksAFrame) return Status::Ok();
  return ResourceExhausted(std::string("the frame touches more than ")
                               .append(std::to_string(kMaxBlocksAFrame))
                               .append(" blocks of the map: use larger voxels, a shorter range, or smaller frames"))
      .WithReason("FRAME_TOO_LARGE");
}

/// Whether the frame agrees with the map, before it is fused.
Status MapBuilder::Impl::Judge(const PanopticFrame& frame, ImplausibleFrames implausible, FrameReport& report) {
  const StageClock clock(report.check_s);
  check = judge.Judge(frame, map);
  if (check.IsPlausible() || implausible == ImplausibleFrames::kFuse) return Status::Ok();
  const FrameWarning& warning = check.warnings.front();
  return InvalidArgument("the frame is implausible: " + warning.message)
      .WithReason("IMPLAUSIBLE_FRAME")
      .WithMetadata("fault", std::string(FaultName(warning.fault)));
}

std::vector<Assignment> MapBuilder::Impl::Associate(const PanopticFrame& frame,
                                                    const std::vector<SegmentBundles>& segments, FrameReport& report) {
  const StageClock clock(report.track_s);
  std::vector<Assignment> assignments = tracker.Assign(frame, segments, map);
  NotePairs(segments, tracker.overlaps(), map);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const bool is_unknown = assignments[s].submap == kUnknownSubmap;
    if (is_unknown) report.num_unknown_points += segments[s].num_points;
    report.num_created += assignments[s].is_new;
    report.num_matched += !is_unknown && !assignments[s].is_new;
  }
  return assignments;
}

void MapBuilder::Impl::Fuse(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                            const std::vector<Assignment>& assignments, const std::stop_token& stop,
                            FrameReport& report) {
  const StageClock clock(report.fuse_s);
  report.num_voxels_updated = FuseFrame(frame, segments, assignments, map, *pool, journal, stop);
}

/// Returns the submaps that lost a part of their surface.
std::vector<SubmapId> MapBuilder::Impl::LookThrough(const PanopticFrame& frame, const std::stop_token& stop,
                                                    FrameReport& report) {
  const SpaceConfig& config = map.info().config.space;
  if (!config.free && !config.gone) return {};
  const StageClock clock(report.free_s);
  return space.Look(frame, map, *pool, stop);
}

/// Things that were not observed for a while become inactive, so they may be refined or found absent.
void MapBuilder::Impl::Settle(const PanopticFrame& frame, const std::vector<Assignment>& assignments,
                              std::vector<SubmapId> contradicted, FrameReport& report) {
  const StageClock clock(report.activity_s);
  std::vector<SubmapId> observed;
  observed.reserve(assignments.size());
  for (const Assignment& assignment : assignments) observed.push_back(assignment.submap);
  std::vector<SubmapId>& doubted = contradicted;  // contradicted, or about to become inactive
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    if (info.panoptic == Panoptic::kThing && info.activity == Activity::kActive) doubted.push_back(info.id);
  }
  report.num_dissolved = UpdateActivity(frame, observed, map);
  if (map.info().config.space.gone) UpdatePresence(frame, observed, doubted, map);
  map.mutable_info().num_frames += 1;
}

void MapBuilder::Impl::Refine(FrameReport& report) {
  const StageClock clock(report.refine_s);
  report.refinement = RefineOnTheSide(report);
}

RefinementReport MapBuilder::Impl::TakeOver(const BackgroundRefinement::Outcome& outcome) {
  RefinementReport report = outcome.report;
  report.num_deferred_blocks = AdoptRefinement(outcome.changes, map);
  refinement_total += report;
  round = outcome.round;
  return report;
}

/// Only while no refinement is running, because it uses the objects of its start.
void MapBuilder::Impl::CareForObjects(FrameReport& report) {
  report.num_merged += MergePairs(map, kMergedBlocksATurn);
  report.num_dissolved += DissolveRemnants(map);
}

/// Turns depend on the number of frames in the map, not in this session, so a map that was saved and loaded in between
/// begins a round at the same frames. Returns the adopted refinement, if any.
std::optional<RefinementReport> MapBuilder::Impl::RefineOnTheSide(FrameReport& frame_report) {
  const MapConfig& config = map.info().config;
  const RefinementConfig& refine = config.refinement;
  if (refine.every_frames == 0 || !(refine.management || refine.crf)) return std::nullopt;
  std::optional<RefinementReport> report;
  const std::int64_t since_turn = map.info().num_frames % refine.every_frames;
  const bool is_turn = since_turn == 0;
  const int most_steps = std::min(kMostStepsARound, refine.every_frames);
  const bool is_step = since_turn % (refine.every_frames / most_steps) == 0;
  is_overdue = is_overdue || (is_step && refinement.IsUnderWay());
  if (is_overdue && refinement.IsUnderWay() && (timing == RefinementTiming::kReproducible || refinement.IsReady())) {
    if (const auto outcome = refinement.Take()) report = TakeOver(*outcome);
    is_overdue = false;
  }
  if (refinement.IsUnderWay()) return report;
  if (is_turn && round.IsFinished()) CareForObjects(frame_report);
  const bool goes_on = !round.IsFinished() && (is_step || report.has_value());
  if (is_waiting || goes_on || (is_turn && round.IsFinished())) {
    auto slot = slots ? RefinementSlots::TryTake(slots) : std::nullopt;
    is_waiting = slots && !slot;
    if (!is_waiting) refinement.Start(map.Freeze(), round, most_steps, std::move(slot));
  }
  return report;
}

void MapBuilder::Impl::PruneEmptyBlocks() {
  std::vector<SubmapId> ids;
  for (const auto& submap : map.submaps()) {
    if (submap->info().is_locked) continue;
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

void MapBuilder::Impl::GoBackTo(Map&& before) {
  journal.TakeBack();  // from blocks that `before` shares
  journal.GiveBuffersBack();
  map = std::move(before);
  bundler.GiveBuffersBack();  // may hold incomplete results; also frees memory
  space = FreeSpaceFinder();
}

MapBuilder::MapBuilder(MapInfo info, std::shared_ptr<ThreadPool> pool, RefinementTiming timing)
    : impl_(std::make_unique<Impl>(Map(std::move(info)), std::move(pool), timing)) {}
MapBuilder::MapBuilder(std::shared_ptr<const MapSnapshot> snapshot, std::shared_ptr<ThreadPool> pool,
                       RefinementTiming timing, std::shared_ptr<RefinementSlots> slots)
    : impl_(std::make_unique<Impl>(Map(std::move(snapshot)), std::move(pool), timing, std::move(slots))) {}
MapBuilder::MapBuilder(MapInfo info, int num_threads, RefinementTiming timing)
    : MapBuilder(std::move(info), std::make_shared<ThreadPool>(num_threads), timing) {}
MapBuilder::MapBuilder(std::shared_ptr<const MapSnapshot> snapshot, int num_threads, RefinementTiming timing)
    : MapBuilder(std::move(snapshot), std::make_shared<ThreadPool>(num_threads), timing) {}
MapBuilder::~MapBuilder() = default;

Map& MapBuilder::map() { return impl_->map; }
const Map& MapBuilder::map() const { return impl_->map; }
const RefinementReport& MapBuilder::refinement_total() const { return impl_->refinement_total; }

/// The stages of the paper's Fig. 2, from left to right.
Result<FrameReport> MapBuilder::Impl::IntegrateChecked(const PanopticFrame& frame, const std::stop_token& stop,
                                                       ImplausibleFrames implausible) {
  FrameReport report;
  const auto& segments = Bundle(frame, report);  // sensor data to point segments
  if (Status size = CheckSize(frame, segments); !size.ok()) {
    bundler.GiveBuffersBack();  // so that a huge frame does not keep its buffers for ever
    return size;
  }
  ThrowIfStopped(stop);
  if (may_read_ahead || CountPages().table_bytes > 0) ReadTilesAhead(segments, map, *pool);
  DHPMAP_RETURN_IF_ERROR(Judge(frame, implausible, report));    // does it agree with the map
  const auto assignments = Associate(frame, segments, report);  // (A) a submap for each segment, II-B
  Fuse(frame, segments, assignments, stop, report);             // (B) ray tracing into it, II-C
  const auto contradicted = LookThrough(frame, stop, report);   // what the rays passed is free
  Settle(frame, assignments, contradicted, report);             // what (C) and (D) may work on, II-D
  judge.NoteFused(frame);
  Refine(report);    // (C) and (D), II-D and II-E; last: once it looks at the state, nothing may be taken back
  journal.Forget();  // the frame is fused
  return report;
}

Result<FrameReport> MapBuilder::Integrate(const PanopticFrame& frame, const std::stop_token& stop,
                                          ImplausibleFrames implausible) {
  impl_->check = {};
  std::optional<Map> before;
  try {
    DHPMAP_RETURN_IF_ERROR(impl_->CheckFrame(frame));
    before = impl_->map.ForkInPlace();
    const MapInfo& info = impl_->map.info();
    const std::optional<PanopticFrame> labelled = WithoutHiddenThings(frame, *info.label_set);
    const std::optional<PanopticFrame> rest = WithoutKeptClear(labelled ? *labelled : frame, info.kept_clear);
    return impl_->IntegrateChecked(rest ? *rest : labelled ? *labelled : frame, stop, implausible);
  } catch (const Stopped&) {
    if (before) impl_->GoBackTo(*std::move(before));
    return Cancelled("the frame was given up: the map is as it was");
  } catch (const std::bad_alloc&) {
    if (before) impl_->GoBackTo(*std::move(before));
    return ResourceExhausted("there is not enough memory for the frame").WithReason("OUT_OF_MEMORY");
  } catch (const StatusError& error) {  // voxels needed by the frame are unreadable
    if (before) impl_->GoBackTo(*std::move(before));
    return error.status();
  } catch (const std::exception& error) {
    if (before) impl_->GoBackTo(*std::move(before));
    return Internal("the frame could not be fused: the log of the server has the cause").WithCause(error.what());
  } catch (...) {
    if (before) impl_->GoBackTo(*std::move(before));
    return Internal("the frame could not be fused");
  }
}

FrameCheck MapBuilder::TakeCheck() { return std::exchange(impl_->check, {}); }
void MapBuilder::ForgetStamp(const std::string& session) { impl_->judge.ForgetStamp(session); }

std::optional<RefinementReport> MapBuilder::Impl::Finish(const std::function<bool()>& is_cancelled) {
  refinement.Cancel();
  is_overdue = is_waiting = false;
  const auto slot = slots ? RefinementSlots::Take(slots, is_cancelled) : std::nullopt;
  bundler.GiveBuffersBack();  // no frame comes for some time
  journal.GiveBuffersBack();
  GiveBackFreeMemory();  // what was under way had a state of the map of its own
  DeactivateAll(map);
  if (map.info().config.space.gone) UpdatePresenceOfAll(map);
  MergePairs(map, std::numeric_limits<std::size_t>::max());
  PendingCubes pending = round.pending();
  pending.Note(*map.Freeze(), RimOfLabels(map.info().config));
  const std::vector<CubeIndex> cubes(pending.cubes().begin(), pending.cubes().end());
  const RefinementRegion all(cubes);
  RefinementReport report = RefineMap(map, *pool, &all, is_cancelled);
  if (is_cancelled && is_cancelled()) return std::nullopt;
  if (map.info().config.space.gone) UpdatePresenceOfAll(map);  // things whose voxels others got are absent
  const MapConfig& config = map.info().config;
  if (config.refinement.least_apart_voxels > 0) {
    SplitApartThings(2 * config.tracking.split_gap_vox, config.refinement.least_apart_voxels, map);
  }
  DissolveRemnants(map);  // needs voxel labels
  if (map.info().config.refinement.drop_voxel_labels && map.info().config.refinement.management) {
    report.num_bytes_dropped = DropVoxelLabels(map);
  }
  PruneEmptyBlocks();
  GiveBackFreeMemory();
  pending.Remove(cubes);
  pending.NoteRefined(*map.Freeze());
  round = RefinementRound(std::move(pending));
  refinement_total += report;
  return report;
}

std::optional<RefinementReport> MapBuilder::Finish(const std::function<bool()>& is_cancelled) {
  Map before = impl_->map.Fork();
  try {
    if (auto report = impl_->Finish(is_cancelled)) return report;
  } catch (...) {
    impl_->GoBackTo(std::move(before));
    throw;
  }
  impl_->GoBackTo(std::move(before));
  return std::nullopt;
}

RefinementReport MapBuilder::Finish() { return *Finish({}); }

}  // namespace dhpmap

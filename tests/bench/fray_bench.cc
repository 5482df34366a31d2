// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "clients/datasets/open_dataset.h"
#include "clients/evaluator/evaluation.h"
#include "clients/evaluator/experiment.h"
#include "clients/evaluator/map_surface.h"
#include "clients/evaluator/output.h"
#include "clients/evaluator/truth_points.h"
#include "mapping/pipeline/map_builder.h"
#include "tests/bench/bench.h"
#include "tests/bench/frames.h"

namespace dhpmap::bench {
namespace {

using evaluator::ClassMap;
using evaluator::Truth;
using evaluator::TruthPoints;

Result<MapInfo> InfoFor(const Dataset& dataset, const FrayBenchOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(const auto settings, evaluator::ParseSettings(options.settings));
  MapInfo info;
  info.name = "fray";
  DHPMAP_ASSIGN_OR_RETURN(info.config, evaluator::ConfigFor(dataset.preset(), settings));
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(dataset.label_classes()));
  info.label_set = std::make_shared<const LabelSet>(std::move(label_set));
  return info;
}

/// Calls use(frame) for the frames of a recording.
template <typename Use>
Status ForEachFrame(Dataset& dataset, std::size_t num_frames, Use&& use) {
  const std::size_t end = num_frames == 0 ? dataset.num_frames() : std::min(num_frames, dataset.num_frames());
  for (std::size_t i = 0; i < end; ++i) {
    const Result<DatasetFrame> read = dataset.Read(i);
    if (!read.ok()) continue;
    DHPMAP_ASSIGN_OR_RETURN(const PanopticFrame frame, DecodeFrame(*read, dataset.has_persistent_ids()));
    DHPMAP_RETURN_IF_ERROR(use(frame));
  }
  return Status::Ok();
}

/// Which true objects the surfaces of the map's things lie on, by voxels.
std::map<SubmapId, std::map<std::uint32_t, std::int64_t>> WhatThingsHold(const Map& map, const Truth& truth) {
  std::map<SubmapId, std::map<std::uint32_t, std::int64_t>> held;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    if (info.panoptic != Panoptic::kThing) continue;
    auto& objects = held[info.id];
    for (const BlockEntry& entry : submap->blocks().entries()) {
      for (int linear = 0; entry.tsdf != nullptr && linear < kBlockVoxels; ++linear) {
        const auto i = static_cast<std::size_t>(linear);
        if (!entry.Shows(linear) || std::abs(entry.tsdf->distance_m[i]) > info.voxel_size_m / 2) continue;
        const Eigen::Vector3d p = info.T_map_submap * VoxelCentre(VoxelIn(entry.index, linear), info.voxel_size_m);
        const auto near = truth.nearest().Find(p.cast<float>(), 2 * info.voxel_size_m);
        ++objects[near.exists() ? truth.labels()[near.index].instance : 0];
      }
    }
  }
  return held;
}

struct Holding {
  SubmapId submap;
  std::int64_t voxels = 0;
};

void PrintThings(const Map& map, const Truth& truth) {
  const LabelSet& label_set = *map.info().label_set;
  std::map<std::uint32_t, std::vector<Holding>> holders;
  std::map<SubmapId, std::string> what;
  for (const auto& [id, objects] : WhatThingsHold(map, truth)) {
    std::uint32_t most = 0;
    std::int64_t all = 0, best = -1;
    for (const auto& [object, voxels] : objects) {
      all += voxels;
      if (voxels > best) best = voxels, most = object;
    }
    holders[most].push_back({id, best});
    const SubmapInfo& info = map.Find(id)->info();
    char text[256];
    std::snprintf(text, sizeof(text), "%5u %-14s %5lld of %5lld voxels, %4lld frames, since %7.1f s, last %7.1f s%s%s",
                  id.value, label_set.Find(info.class_id)->name.c_str(), static_cast<long long>(best),
                  static_cast<long long>(all), static_cast<long long>(info.num_frames_observed),
                  static_cast<double>(info.first_observed_ns) * 1e-9, static_cast<double>(info.last_observed_ns) * 1e-9,
                  info.is_confirmed ? "" : ", unconfirmed", map.Find(id)->IsAbsent() ? ", absent" : "");
    what[id] = text;
  }
  for (const auto& [object, held] : holders) {
    std::printf("object %u\n", object);
    for (const Holding& holding : held) std::printf("  %s\n", what[holding.submap].c_str());
  }
}

/// A map of the recordings so far, and what is true of all of them.
struct Mapped {
  std::optional<MapBuilder> builder;
  std::optional<ClassMap> classes;
  std::unique_ptr<Truth> truth;
  std::vector<double> frame_s, waited_s;  ///< of the last recording
};

/// The points of the first recording alone: the noise of each more would put elements farther off the surfaces.
Status MeasureTruth(Dataset& labelled, const MapConfig& config, std::size_t num_frames, Mapped& mapped) {
  TruthPoints points(config.integration);
  DHPMAP_RETURN_IF_ERROR(ForEachFrame(labelled, num_frames, [&](const PanopticFrame& frame) {
    points.Add(frame);
    return Status::Ok();
  }));
  const auto protocol = evaluator::ProtocolForElements(evaluator::ProtocolFor(config.voxel_size_m), points.cell_m());
  mapped.truth = std::make_unique<Truth>(points.Elements(), *mapped.classes, protocol);
  return Status::Ok();
}

Status MapRecording(const std::string& directory, const FrayBenchOptions& options, Mapped& mapped) {
  DHPMAP_ASSIGN_OR_RETURN(const auto dataset, OpenDataset(directory, kAnyFormat, LabelSource::kPredicted));
  DHPMAP_ASSIGN_OR_RETURN(const auto labelled, OpenDataset(directory, kAnyFormat, LabelSource::kGroundTruth));
  if (!mapped.builder) {
    DHPMAP_ASSIGN_OR_RETURN(MapInfo info, InfoFor(*dataset, options));
    DHPMAP_ASSIGN_OR_RETURN(mapped.classes,
                            evaluator::FindClassMap(directory, labelled->label_classes(), dataset->label_classes()));
    DHPMAP_RETURN_IF_ERROR(MeasureTruth(*labelled, info.config, options.num_frames, mapped));
    mapped.builder.emplace(std::move(info), options.num_threads);
  }
  mapped.frame_s.clear();
  mapped.waited_s.clear();
  DHPMAP_RETURN_IF_ERROR(ForEachFrame(*dataset, options.num_frames, [&](const PanopticFrame& frame) -> Status {
    DHPMAP_ASSIGN_OR_RETURN(const FrameReport report, mapped.builder->Integrate(frame));
    mapped.frame_s.push_back(report.total_s() - report.refine_s);
    mapped.waited_s.push_back(report.refine_s);
    return Status::Ok();
  }));
  mapped.builder->Finish();
  return Status::Ok();
}

void PrintScores(const Map& map, const Truth& truth, const evaluator::Scores& scores) {
  std::map<std::uint32_t, std::int64_t> objects;
  for (const auto& label : truth.labels()) objects[label.instance] += label.instance != 0;
  const auto num_objects = std::count_if(objects.begin(), objects.end(), [&](const auto& object) {
    return object.second >= truth.protocol().min_elements;
  });
  const auto num_things = std::count_if(map.submaps().begin(), map.submaps().end(),
                                        [](const auto& submap) { return submap->info().panoptic == Panoptic::kThing; });
  int num_matched = 0, num_false = 0, num_missed = 0;
  for (std::size_t c = 0; c < scores.panoptics.classes.size(); ++c) {
    if (!truth.classes().classes()[c].is_thing) continue;
    num_matched += scores.panoptics.classes[c].num_matched;
    num_false += scores.panoptics.classes[c].num_false;
    num_missed += scores.panoptics.classes[c].num_missed;
  }
  std::printf(
      "%lld frames: %lld things for %lld objects (%.3f), matched %d false %d missed %d, PQ %.4f (things %.4f) mIoU "
      "%.4f "
      "accuracy %.4f",
      static_cast<long long>(map.info().num_frames), static_cast<long long>(num_things),
      static_cast<long long>(num_objects), static_cast<double>(num_things) / static_cast<double>(num_objects),
      num_matched, num_false, num_missed, scores.panoptics.all.pq, scores.panoptics.things.pq,
      scores.semantics.mean_iou, scores.semantics.accuracy);
}

}  // namespace

Status RunFrayBench(const FrayBenchOptions& options) {
  Mapped mapped;
  ThreadPool pool(options.num_threads);
  for (const std::string& directory : options.directories) {
    DHPMAP_RETURN_IF_ERROR(MapRecording(directory, options, mapped));
    if (mapped.frame_s.empty()) return InvalidArgument(directory + " has no frames");
    const Map& map = mapped.builder->map();
    const Truth& truth = *mapped.truth;
    const auto surface = evaluator::SurfaceOf(map, evaluator::SurfaceKind::kOneField);
    if (options.list && &directory == &options.directories.back()) PrintThings(map, truth);
    PrintScores(map, truth, evaluator::Evaluate(truth, surface, true, pool, nullptr));
    const Summary frame = Summarize(mapped.frame_s), waited = Summarize(mapped.waited_s);
    std::printf("; frame %.2f ms (p95 %.2f), waits %.2f ms (most %.2f)\n", 1e3 * frame.mean, 1e3 * frame.p95,
                1e3 * waited.mean, 1e3 * *std::max_element(mapped.waited_s.begin(), mapped.waited_s.end()));
    std::fflush(stdout);
  }
  return Status::Ok();
}

}  // namespace dhpmap::bench

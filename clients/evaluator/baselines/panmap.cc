// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/panmap.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "clients/evaluator/baselines/baselines.h"
#include "clients/evaluator/baselines/panmap_merging.h"
#include "clients/evaluator/baselines/stored_distance.h"
#include "clients/evaluator/baselines/whole_frame.h"
#include "mapping/fusion/segment_parts.h"

namespace dhpmap::evaluator {

Panmap::Panmap(const SystemSetup& setup, std::string name)
    : name_(std::move(name)),
      setup_(setup),
      pool_(setup.num_threads),
      bundler_(setup.config.integration, pool_),
      tracker_(setup.config, *setup.label_set, pool_),
      integrator_(setup.config, pool_) {}

/// As in MapBuilder.
const std::vector<SegmentBundles>& Panmap::Bundle(const PanopticFrame& frame) {
  auto& segments = bundler_.BundleFrame(frame, frame.T_map_sensor, setup_.config.voxel_size_m);
  const int gap_vox = setup_.config.tracking.split_gap_vox;
  if (gap_vox == 0 || frame.has_persistent_ids) return segments;
  std::vector<bool> is_thing;
  for (const SegmentInfo& segment : frame.segments) {
    is_thing.push_back(segment.class_id && setup_.label_set->Find(*segment.class_id)->panoptic == Panoptic::kThing);
  }
  SplitIntoParts(is_thing, gap_vox, segments);
  return segments;
}

Status Panmap::Integrate(const PanopticFrame& frame) {
  DHPMAP_RETURN_IF_ERROR(ValidateFrame(frame, *setup_.label_set));
  const auto start = std::chrono::steady_clock::now();
  settings_ = PanmapSettingsFor(frame);
  const auto& segments = Bundle(frame);
  DHPMAP_RETURN_IF_ERROR(CheckIsWhole(segments));
  const std::vector<SubmapId> assigned = tracker_.Assign(frame, segments, settings_, submaps_, next_id_);
  integrator_.Integrate(frame, segments, assigned, submaps_);
  UpdateActivity();
  times_.num_frames += 1;
  times_.integrate_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return Status::Ok();
}

void Panmap::UpdateActivity() {
  std::vector<SubmapId> deactivated;
  std::erase_if(submaps_, [&](const auto& submap) {
    if (!submap->IsActive()) return false;
    SubmapInfo& info = submap->geometry.mutable_info();
    const bool is_new = info.num_frames_observed == 0;
    if (submap->was_tracked) {
      info.num_frames_observed += 1;
      info.num_frames_missed = 0;
      if (!is_new && submap->num_reobservations_left > 0) --submap->num_reobservations_left;
      return false;
    }
    if (submap->num_reobservations_left > 0) return true;
    if (++info.num_frames_missed >= settings_.deactivate_after_missed) {
      info.activity = Activity::kInactive;
      deactivated.push_back(info.id);
    }
    return false;
  });
  for (const SubmapId id : deactivated) {
    const bool is_there =
        std::any_of(submaps_.begin(), submaps_.end(), [id](const auto& submap) { return submap->geometry.id() == id; });
    if (is_there) MergeWithInactive(id, setup_.config, settings_, submaps_);
  }
}

void Panmap::Finish() {
  const auto start = std::chrono::steady_clock::now();
  std::vector<SubmapId> ids;
  for (const auto& submap : submaps_) {
    submap->geometry.PruneBlocks();
    submap->geometry.UpdateBoundingSphere();
    submap->geometry.mutable_info().activity = Activity::kInactive;
    ids.push_back(submap->geometry.id());
  }
  for (std::size_t i = 0; i < ids.size();) {
    const bool is_there = std::any_of(submaps_.begin(), submaps_.end(),
                                      [&](const auto& submap) { return submap->geometry.id() == ids[i]; });
    const bool has_merged = is_there && MergeWithInactive(ids[i], setup_.config, settings_, submaps_);
    i = has_merged ? 0 : i + 1;
  }
  times_.finish_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

LabelledSurface Panmap::Surface() const {
  LabelledSurface surface;
  for (const auto& submap : submaps_) {
    const Mesh mesh = ExtractMesh(submap->OwnGeometry(), *setup_.label_set, MeshColoring::kSensor);
    surface.instance_scores[submap->geometry.id().value] = submap->Confidence();
    if (mesh.vertices_m.empty()) continue;
    AppendMesh(mesh, surface.mesh);
  }
  return surface;
}

std::optional<PointLabels> Panmap::LabelsAt(std::span<const Eigen::Vector3f> points_m) const {
  PointLabels labels;
  labels.classes.assign(points_m.size(), 0);
  labels.instances.assign(points_m.size(), 0);
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const VoxelIndex voxel = VoxelAt(points_m[i].cast<double>(), setup_.config.voxel_size_m);
    auto nearest_m = static_cast<float>(setup_.config.truncation_m);
    for (const auto& submap : submaps_) {
      const std::optional<float> distance_m = DistanceAt(submap->geometry, voxel);
      if (!distance_m || std::abs(*distance_m) >= nearest_m || !submap->Belongs(voxel)) continue;
      nearest_m = std::abs(*distance_m);
      labels.classes[i] = submap->geometry.info().class_id.value;
      labels.instances[i] = submap->geometry.id().value;
    }
  }
  return labels;
}

std::unique_ptr<MappingSystem> MakePanmap(const SystemSetup& setup) { return std::make_unique<Panmap>(setup); }

std::unique_ptr<MappingSystem> MakePanmapOfWholeSegments(SystemSetup setup) {
  setup.config.tracking.split_gap_vox = 0;
  return std::make_unique<Panmap>(setup, "panmap_whole_segments");
}

}  // namespace dhpmap::evaluator

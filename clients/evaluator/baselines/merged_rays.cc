// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/merged_rays.h"

#include <algorithm>
#include <tuple>

#include "clients/evaluator/baselines/whole_frame.h"
#include "mapping/fusion/grid_ray.h"

namespace dhpmap::evaluator {
namespace {

PanopticFrame WithoutSegments(const PanopticFrame& frame) {
  PanopticFrame out;
  out.T_map_sensor = frame.T_map_sensor;
  if (frame.camera) out.camera = {frame.camera->camera, frame.camera->depth_m, frame.camera->color, {}};
  if (frame.lidar) out.lidar = {frame.lidar->points_m, frame.lidar->color, {}};
  return out;
}

/// Points of one class in one bundle; several segments may contribute.
struct Part {
  std::uint32_t bundle;
  ClassId class_id;
  std::uint32_t num_points;
};

}  // namespace

Status MergedRays::Assign(const PanopticFrame& frame, double voxel_size_m) {
  rays_ = nullptr;
  labels_.clear();
  first_label_.assign(1, 0);
  const auto& merged = geometry_.BundleFrame(WithoutSegments(frame), frame.T_map_sensor, voxel_size_m);
  DHPMAP_RETURN_IF_ERROR(CheckIsWhole(merged));
  if (merged.empty()) return Status::Ok();
  const auto& labelled = labelled_.BundleFrame(frame, frame.T_map_sensor, voxel_size_m);
  DHPMAP_RETURN_IF_ERROR(CheckIsWhole(labelled));
  rays_ = &merged.front();
  first_label_.assign(rays_->bundles.size() + 1, 0);
  CountLabels(frame, labelled);
  return Status::Ok();
}

void MergedRays::CountLabels(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments) {
  std::vector<Part> parts;
  for (const SegmentBundles& segment : segments) {
    if (segment.row < 0) continue;
    const std::optional<ClassId> class_id = frame.segments[static_cast<std::size_t>(segment.row)].class_id;
    if (!class_id) continue;
    for (const BundleCell& cell : segment.cells) {
      const BundleCell& whole = *rays_->Find(cell.block);  // contains the same points
      for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
        const Bundle& bundle = segment.bundles[b];
        parts.push_back({whole.BundleAt(bundle.linear), *class_id, bundle.num_points});
      }
    }
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return std::tie(a.bundle, a.class_id) < std::tie(b.bundle, b.class_id);
  });
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0 && parts[i].bundle == parts[i - 1].bundle && parts[i].class_id == parts[i - 1].class_id) {
      labels_.back().num_points += parts[i].num_points;
    } else {
      labels_.push_back({parts[i].class_id, parts[i].num_points});
      ++first_label_[parts[i].bundle + 1];
    }
  }
  for (std::size_t b = 1; b < first_label_.size(); ++b) first_label_[b] += first_label_[b - 1];
}

void ObserveLabels(const MergedRays& merged, const RayOrigin& origin, const MapConfig& config, SemanticLayer& layer) {
  if (merged.rays() == nullptr) return;
  const SegmentBundles& rays = *merged.rays();
  const auto voxel_size_m = static_cast<float>(config.voxel_size_m);
  const auto truncation_m = static_cast<float>(config.truncation_m);
  for (const BundleCell& cell : rays.cells) {
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      const std::span<const LabelFrequency> labels = merged.LabelsOf(b);
      if (labels.empty()) continue;
      const Bundle& bundle = rays.bundles[b];
      const VoxelIndex end = VoxelIn(cell.block, bundle.linear);
      const Eigen::Vector3f end_m = bundle.weighted_sum_m / bundle.weight;
      const float range_m = end_m.norm();
      GridRay ray(origin.voxel, origin.offset_vox, end_m / range_m, voxel_size_m,
                  std::max(range_m - truncation_m, 0.0f), range_m + truncation_m);
      for (int step = ray.num_voxels(); step > 0; --step, ray.Next()) {
        const VoxelIndex voxel = ray.voxel();
        if (range_m - ray.CentreAlongRay_m() <= -truncation_m) continue;
        if (config.integration.anti_grazing && voxel != end && rays.EndsIn(voxel)) continue;
        layer.Observe(voxel, labels);
      }
    }
  }
}

}  // namespace dhpmap::evaluator

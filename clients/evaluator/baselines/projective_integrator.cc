// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/projective_integrator.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mapping/tracking/visibility.h"

namespace dhpmap::evaluator {
namespace {

std::uint8_t Blend(std::uint8_t old_value, float old_weight, std::uint8_t value, float weight) {
  return static_cast<std::uint8_t>(
      (static_cast<float>(old_value) * old_weight + static_cast<float>(value) * weight) / (old_weight + weight) + 0.5f);
}

}  // namespace

/// A block of an active submap that may be in view.
struct ProjectiveIntegrator::Target {
  BlockIndex index;
  TsdfBlock* tsdf = nullptr;
  BelongingBlock* belonging = nullptr;  ///< null: the submap was not tracked, so its counts do not change
  ClassId class_id;
};

/// The frame in the form that the integrator needs.
struct ProjectiveIntegrator::Sight {
  RangeView view;
  Transform T_sensor_map;
  std::vector<std::optional<ClassId>> class_of_row;  ///< of the submap assigned to the segment
};

void ProjectiveIntegrator::Allocate(const SegmentBundles& segment, const Eigen::Vector3d& sensor_m,
                                    Submap& submap) const {
  for (const BundleCell& cell : segment.cells) {
    submap.MutableTsdf(cell.block);
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      const Bundle& bundle = segment.bundles[b];
      const Eigen::Vector3d ray_m = (bundle.weighted_sum_m / bundle.weight).cast<double>();
      const Eigen::Vector3d step_m = ray_m.normalized() * config_.voxel_size_m;
      for (const Eigen::Vector3d& p_m :
           {Eigen::Vector3d(sensor_m + ray_m - step_m), Eigen::Vector3d(sensor_m + ray_m + step_m)}) {
        const BlockIndex block = BlockOf(VoxelAt(p_m, config_.voxel_size_m));
        if (block != cell.block) submap.MutableTsdf(block);
      }
    }
  }
}

std::vector<ProjectiveIntegrator::Target> ProjectiveIntegrator::FindTargets(const PanopticFrame& frame,
                                                                            PanmapSubmaps& submaps) const {
  const double side_m = kBlockSide * config_.voxel_size_m;
  const double radius_m = std::sqrt(3.0) / 2 * side_m;
  const double max_range_m = config_.integration.max_range_m;
  std::vector<Target> targets;
  for (const auto& submap : submaps) {
    Submap& geometry = submap->geometry;
    if (!submap->IsActive() || !MayBeInView(frame, max_range_m, geometry.bounding_sphere())) continue;
    std::vector<BlockIndex> in_view;
    for (const BlockEntry& entry : geometry.blocks().entries()) {
      const Eigen::Vector3d centre_m =
          BlockCorner(entry.index, config_.voxel_size_m) + Eigen::Vector3d::Constant(side_m / 2);
      if (MayBeInView(frame, max_range_m, {centre_m, radius_m})) in_view.push_back(entry.index);
    }
    for (const BlockIndex index : in_view) {
      BelongingBlock* belonging = submap->was_tracked ? &submap->belonging[index] : nullptr;
      targets.push_back({index, &geometry.MutableTsdf(index), belonging, geometry.info().class_id});
    }
  }
  return targets;
}

void ProjectiveIntegrator::UpdateBlock(const Sight& sight, Target& target) const {
  const auto voxel_size_m = static_cast<float>(config_.voxel_size_m);
  const auto truncation_m = static_cast<float>(config_.truncation_m);
  const auto min_range_m = static_cast<float>(config_.integration.min_range_m);
  const auto max_range_m = static_cast<float>(config_.integration.max_range_m);
  const auto max_weight = static_cast<float>(config_.integration.max_weight);
  const bool fades = config_.integration.weight_dropoff && truncation_m > voxel_size_m * 1.001f;
  const Eigen::Vector3f first_m =
      (sight.T_sensor_map * VoxelCentre(VoxelIn(target.index, 0), config_.voxel_size_m)).cast<float>();
  const Eigen::Matrix3f step_m = sight.T_sensor_map.linear().cast<float>() * voxel_size_m;

  for (int linear = 0; linear < kBlockVoxels; ++linear) {
    const VoxelIndex v = VoxelIn({0, 0, 0}, linear);
    const Eigen::Vector3f p_m =
        first_m + step_m * Eigen::Vector3f(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
    const float range_m = p_m.norm();
    RangeReading reading;
    if (range_m < min_range_m || range_m > max_range_m || !sight.view.Read(p_m, reading)) continue;
    const float sdf_m = reading.range_m - range_m;
    if (sdf_m < -truncation_m) continue;
    float weight = sight.view.Weight(p_m, voxel_size_m);
    if (fades && sdf_m < -voxel_size_m) weight *= (truncation_m + sdf_m) / (truncation_m - voxel_size_m);
    const auto i = static_cast<std::size_t>(linear);
    const float old_weight = target.tsdf->weight[i];
    if (!(weight > 0) || old_weight + weight < kMinObservedWeight) continue;

    const float clamped_m = std::min(sdf_m, truncation_m);
    float& distance_m = target.tsdf->distance_m[i];
    distance_m =
        std::clamp((distance_m * old_weight + clamped_m * weight) / (old_weight + weight), -truncation_m, truncation_m);
    target.tsdf->weight[i] = std::min(old_weight + weight, max_weight);
    if (sdf_m >= truncation_m) continue;  // free space: no colour or class
    Color& color = target.tsdf->color[i];
    color = {Blend(color.r, old_weight, reading.color.r, weight), Blend(color.g, old_weight, reading.color.g, weight),
             Blend(color.b, old_weight, reading.color.b, weight)};
    if (target.belonging == nullptr) continue;
    const bool belongs =
        reading.row >= 0 && sight.class_of_row[static_cast<std::size_t>(reading.row)] == target.class_id;
    target.belonging->Add(i, belongs);
  }
}

void ProjectiveIntegrator::Integrate(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments,
                                     const std::vector<SubmapId>& assigned, PanmapSubmaps& submaps) {
  Sight sight{RangeView(frame, config_.integration), frame.T_map_sensor.inverse(),
              std::vector<std::optional<ClassId>>(frame.segments.size())};
  pool_.ParallelFor(submaps.size(), [&](std::size_t i) {
    Submap& geometry = submaps[i]->geometry;
    const std::size_t num_blocks = geometry.blocks().size();
    for (std::size_t s = 0; s < segments.size(); ++s) {
      if (assigned[s] == geometry.id()) Allocate(segments[s], frame.T_map_sensor.translation(), geometry);
    }
    if (geometry.blocks().size() != num_blocks) geometry.UpdateBoundingSphere();
  });
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (assigned[s] == kUnknownSubmap) continue;
    const auto row = static_cast<std::size_t>(segments[s].row);
    sight.class_of_row[row] = frame.segments[row].class_id;  // segments are only assigned to submaps of their class
  }
  std::vector<Target> targets = FindTargets(frame, submaps);
  pool_.ParallelFor(targets.size(), [&](std::size_t i) { UpdateBlock(sight, targets[i]); });
}

}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/point_lookup.h"

#include <utility>

#include "mapping/base/grid_reach.h"
#include "mapping/map/voxel_answer.h"
#include "mapping/query/voxel_sampler.h"

namespace dhpmap {

namespace {

/// One submap's answer at the point.
struct Vote {
  const Submap* submap = nullptr;
  VoxelSample voxel;
  VoxelSupport support;
};

/// Farther than the truncation a distance says only that: it is what carving leaves, but for rounding.
bool IsNearSurface(const Submap& submap, const VoxelSample& voxel) {
  return voxel.distance_m() < 0.999 * submap.info().truncation_m;
}

bool IsLookedThrough(const MapSnapshot& map, const Eigen::Vector3d& p_map) {
  const double voxel_size_m = map.info().config.voxel_size_m;
  const bool is_on_grid = (p_map.array().abs() <= GridReach_m(voxel_size_m)).all();
  return is_on_grid && map.free_space()->IsFree(VoxelAt(p_map, voxel_size_m));
}

}  // namespace

PointLookup::PointLookup(std::shared_ptr<const MapSnapshot> snapshot)
    : snapshot_(std::move(snapshot)), index_(snapshot_->submaps()) {}

PointInfo PointLookup::At(const Eigen::Vector3d& p_map) const {
  Vote best;
  float total_support = 0;
  bool is_near_surface = false;
  index_.VisitAround(p_map, [&](const SubmapIndex::Entry& entry) {
    const Submap& submap = entry.submap();
    const VoxelSample voxel = SampleVoxelAt(submap, entry.ToSubmap(p_map));
    if (!voxel.IsObserved()) return;
    is_near_surface = is_near_surface || IsNearSurface(submap, voxel);
    const VoxelSupport support = SupportOfVoxel(submap, *voxel.block, voxel.linear);
    total_support += support.observations;
    if (best.submap == nullptr || support > best.support) best = {&submap, voxel, support};
  });
  PointInfo info;
  info.is_free = !is_near_surface && IsLookedThrough(*snapshot_, p_map);
  if (best.submap == nullptr) return info;

  const SubmapInfo& submap = best.submap->info();
  info.is_observed = true;
  info.submap = submap.id;
  info.panoptic = submap.panoptic;
  info.distance_m = best.voxel.distance_m();
  info.weight = best.voxel.weight();
  info.color = best.voxel.color();
  info.class_id = submap.class_id;
  if (submap.panoptic == Panoptic::kUnknown) return info;
  const BestLabel seen = ClassOfVoxel(*best.submap, *best.voxel.block, best.voxel.linear);
  const bool is_labelled = best.voxel.block->labels != nullptr && !best.voxel.block->labels->IsEmpty(best.voxel.linear);
  info.class_confidence = is_labelled && !submap.class_is_fixed ? seen.share : submap.ClassConfidence();
  info.instance_confidence = submap.instance_confidence;
  if (total_support > 0) info.instance_confidence = best.support.observations / total_support;
  return info;
}

}  // namespace dhpmap

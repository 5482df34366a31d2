// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/things_in_view.h"

#include <cmath>

#include "mapping/map/map_grid.h"
#include "mapping/tracking/visibility.h"

namespace dhpmap {
namespace {

/// A candidate that may have observed voxels in a cell.
struct NearCandidate {
  std::size_t column;
  const ThingInView* candidate;
  const BlockEntry* entry;  ///< its block there; null if it has its own grid
  bool may_return;          ///< voxels that were looked through count, too
};

/// The observed weight of a voxel near its surface; 0 elsewhere.
float ObservedWeight(const BlockEntry& entry, int linear, bool may_return, float tolerance_m) {
  const bool counts = may_return ? entry.tsdf->IsObserved(linear) : entry.Shows(linear);
  const auto i = static_cast<std::size_t>(linear);
  return counts && std::abs(entry.tsdf->distance_m[i]) < tolerance_m ? entry.tsdf->weight[i] : 0.0f;
}

/// The same for a candidate with its own pose or voxel size: a bundle is represented by its mean point.
float MovedWeight(const NearCandidate& near, const Eigen::Vector3d& p_map) {
  const Submap& submap = *near.candidate->submap;
  const VoxelIndex voxel = VoxelAt(near.candidate->T_submap_map * p_map, submap.info().voxel_size_m);
  const BlockEntry* entry = submap.blocks().Find(BlockOf(voxel));
  if (entry == nullptr || entry->tsdf == nullptr) return 0;
  return ObservedWeight(*entry, LinearIndex(voxel), near.may_return, near.candidate->tolerance_m);
}

std::vector<ThingInView> FindCandidates(const PanopticFrame& frame, const Map& map) {
  const MapConfig& config = map.info().config;
  std::vector<ThingInView> candidates;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    const BoundingSphere sphere = submap->BoundingSphereInMap();
    if (info.panoptic != Panoptic::kThing || !MayBeInView(frame, config.integration.max_range_m, sphere)) continue;
    candidates.push_back({submap.get(), info.T_map_submap.inverse(), sphere, IsOnMapGrid(info, config),
                          static_cast<float>(config.tracking.depth_tolerance_vox * info.voxel_size_m)});
  }
  return candidates;
}

/// A contradicted voxel counts only for a segment of the candidate's class, which may be the thing come back.
void FindNear(std::span<const ThingInView> candidates, BlockIndex block, std::optional<ClassId> class_id,
              double voxel_size_m, std::vector<NearCandidate>& near) {
  const double side_m = kBlockSide * voxel_size_m;
  const BoundingSphere cell{BlockCorner(block, voxel_size_m) + Eigen::Vector3d::Constant(side_m / 2),
                            std::sqrt(3.0) / 2 * side_m};
  near.clear();
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const ThingInView& candidate = candidates[c];
    if (!candidate.sphere_map.Intersects(cell)) continue;
    const bool may_return = class_id && candidate.submap->info().IsSeenAs(*class_id);
    if (candidate.submap->IsAbsent() && !may_return) continue;
    const BlockEntry* entry = candidate.is_on_map_grid ? candidate.submap->blocks().Find(block) : nullptr;
    if (candidate.is_on_map_grid && (entry == nullptr || entry->tsdf == nullptr)) continue;
    near.push_back({c, &candidate, entry, may_return});
  }
}

/// The candidate's observed weight where the bundle ends, near its surface; else 0.
float WeightAt(const Bundle& bundle, const NearCandidate& near, const Eigen::Vector3d& sensor_map) {
  if (near.entry == nullptr) {
    return MovedWeight(near, sensor_map + (bundle.weighted_sum_m / bundle.weight).cast<double>());
  }
  return ObservedWeight(*near.entry, bundle.linear, near.may_return, near.candidate->tolerance_m);
}

}  // namespace

ThingsInView::ThingsInView(const PanopticFrame& frame, const Map& map)
    : frame_(frame), voxel_size_m_(map.info().config.voxel_size_m), things_(FindCandidates(frame, map)) {}

template <typename Visitor>
void ThingsInView::VisitCells(const SegmentBundles& segment, std::span<const ThingInView> things,
                              Visitor&& visit) const {
  std::optional<ClassId> class_id;
  if (segment.row >= 0) class_id = frame_.segments[static_cast<std::size_t>(segment.row)].class_id;
  std::vector<NearCandidate> near;
  for (const BundleCell& cell : segment.cells) {
    FindNear(things, cell.block, class_id, voxel_size_m_, near);
    if (!near.empty()) visit(cell, near);
  }
}

std::vector<std::uint32_t> ThingsInView::HitsOf(const SegmentBundles& segment) const {
  std::vector<std::uint32_t> hit_by(segment.bundles.size(), kNone);
  const Eigen::Vector3d& sensor_map = frame_.T_map_sensor.translation();
  VisitCells(segment, things_, [&](const BundleCell& cell, const std::vector<NearCandidate>& near) {
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      float most = 0;
      for (const NearCandidate& candidate : near) {
        const float weight = WeightAt(segment.bundles[b], candidate, sensor_map);
        if (weight > most) most = weight, hit_by[b] = static_cast<std::uint32_t>(candidate.column);
      }
    }
  });
  return hit_by;
}

std::int64_t ThingsInView::NumPointsOn(const SegmentBundles& segment, std::size_t thing) const {
  std::int64_t num_points = 0;
  const Eigen::Vector3d& sensor_map = frame_.T_map_sensor.translation();
  VisitCells(segment, {&things_[thing], 1}, [&](const BundleCell& cell, const std::vector<NearCandidate>& near) {
    for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
      const Bundle& bundle = segment.bundles[b];
      if (WeightAt(bundle, near.front(), sensor_map) > 0) num_points += bundle.num_points;
    }
  });
  return num_points;
}

}  // namespace dhpmap

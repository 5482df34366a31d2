// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/things_in_view.h"

#include <cmath>

#include "mapping/map/map_grid.h"
#include "mapping/tracking/visibility.h"

namespace dhpmap {
namespace {

/// A candidate that may have been observed in a cell.
struct NearCandidate {
  std::size_t column;
  const ThingInView* candidate;
  const BlockEntry* entry;  ///< its block there; null if it has a grid of its own
  bool may_return;          ///< what was looked through counts, too
};

/// How much has been observed at the voxel if its surface is near; 0 if not.
float ObservedWeight(const BlockEntry& entry, int linear, bool may_return, float tolerance_m) {
  const bool counts = may_return ? entry.tsdf->IsObserved(linear) : entry.Shows(linear);
  const auto i = static_cast<std::size_t>(linear);
  return counts && std::abs(entry.tsdf->distance_m[i]) < tolerance_m ? entry.tsdf->weight[i] : 0.0f;
}

/// The same for a candidate with a pose or voxel size of its own: a bundle stands at its mean point.
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

/// Where something was and is no longer, a segment of its class may be it come back; anything else is not.
void FindNear(const std::vector<ThingInView>& candidates, BlockIndex block, std::optional<ClassId> class_id,
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

/// Of one cell.
void FindHits(const SegmentBundles& segment, const BundleCell& cell, const std::vector<NearCandidate>& near,
              const Eigen::Vector3d& sensor_map, std::vector<std::uint32_t>& hit_by) {
  for (std::uint32_t b = cell.first_bundle; b < cell.first_bundle + cell.num_bundles; ++b) {
    const Bundle& bundle = segment.bundles[b];
    float most = 0;
    for (const NearCandidate& candidate : near) {
      const float weight =
          candidate.entry != nullptr
              ? ObservedWeight(*candidate.entry, bundle.linear, candidate.may_return, candidate.candidate->tolerance_m)
              : MovedWeight(candidate, sensor_map + (bundle.weighted_sum_m / bundle.weight).cast<double>());
      if (weight > most) most = weight, hit_by[b] = static_cast<std::uint32_t>(candidate.column);
    }
  }
}

}  // namespace

ThingsInView::ThingsInView(const PanopticFrame& frame, const Map& map)
    : frame_(frame), voxel_size_m_(map.info().config.voxel_size_m), things_(FindCandidates(frame, map)) {}

std::vector<std::uint32_t> ThingsInView::HitsOf(const SegmentBundles& segment) const {
  std::optional<ClassId> class_id;
  if (segment.row >= 0) class_id = frame_.segments[static_cast<std::size_t>(segment.row)].class_id;
  std::vector<std::uint32_t> hit_by(segment.bundles.size(), kNone);
  std::vector<NearCandidate> near;
  for (const BundleCell& cell : segment.cells) {
    FindNear(things_, cell.block, class_id, voxel_size_m_, near);
    FindHits(segment, cell, near, frame_.T_map_sensor.translation(), hit_by);
  }
  return hit_by;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/tracking/overlap_table.h"

#include <cmath>
#include <optional>

#include "mapping/map/map_grid.h"
#include "mapping/tracking/visibility.h"

namespace dhpmap {
namespace {

/// A thing that a segment may match, on the map's grid or moved away from it.
struct Candidate {
  const Submap* submap;
  Transform T_submap_map;
  BoundingSphere sphere_map;
  bool is_on_map_grid;
  float tolerance_m;
};

/// A candidate that may have been observed in a cell.
struct NearCandidate {
  std::size_t column;
  const Candidate* candidate;
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

std::vector<Candidate> FindCandidates(const PanopticFrame& frame, const Map& map) {
  const MapConfig& config = map.info().config;
  std::vector<Candidate> candidates;
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
void FindNear(const std::vector<Candidate>& candidates, BlockIndex block, std::optional<ClassId> class_id,
              double voxel_size_m, std::vector<NearCandidate>& near) {
  const double side_m = kBlockSide * voxel_size_m;
  const BoundingSphere cell{BlockCorner(block, voxel_size_m) + Eigen::Vector3d::Constant(side_m / 2),
                            std::sqrt(3.0) / 2 * side_m};
  near.clear();
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const Candidate& candidate = candidates[c];
    if (!candidate.sphere_map.Intersects(cell)) continue;
    const bool may_return = class_id == candidate.submap->info().class_id;
    if (candidate.submap->IsAbsent() && !may_return) continue;
    const BlockEntry* entry = candidate.is_on_map_grid ? candidate.submap->blocks().Find(block) : nullptr;
    if (candidate.is_on_map_grid && (entry == nullptr || entry->tsdf == nullptr)) continue;
    near.push_back({c, &candidate, entry, may_return});
  }
}

void CountHits(const SegmentBundles& segment, const BundleCell& cell, const std::vector<NearCandidate>& near,
               const Eigen::Vector3d& sensor_map, std::vector<std::int64_t>& hits) {
  for (std::uint32_t b = 0; b < cell.num_bundles; ++b) {
    const Bundle& bundle = segment.bundles[cell.first_bundle + b];
    float most = 0;
    std::size_t owner = 0;
    for (const NearCandidate& candidate : near) {
      const float weight =
          candidate.entry != nullptr
              ? ObservedWeight(*candidate.entry, bundle.linear, candidate.may_return, candidate.candidate->tolerance_m)
              : MovedWeight(candidate, sensor_map + (bundle.weighted_sum_m / bundle.weight).cast<double>());
      if (weight > most) most = weight, owner = candidate.column;
    }
    if (most > 0) hits[owner] += bundle.num_points;
  }
}

}  // namespace

double OverlapTable::Iou(std::size_t segment, std::size_t candidate, std::int64_t num_segment_points) const {
  const std::int64_t shared = hits[segment][candidate];
  const std::int64_t all = candidate_hits[candidate] + num_segment_points - shared;
  return all > 0 ? static_cast<double>(shared) / static_cast<double>(all) : 0.0;
}

OverlapTable CountOverlaps(const PanopticFrame& frame, const std::vector<SegmentBundles>& segments, const Map& map,
                           ThreadPool& pool) {
  const std::vector<Candidate> candidates = FindCandidates(frame, map);
  OverlapTable table;
  for (const Candidate& candidate : candidates) table.candidates.push_back(candidate.submap->id());
  table.hits.assign(segments.size(), std::vector<std::int64_t>(candidates.size(), 0));
  pool.ParallelFor(segments.size(), [&](std::size_t s) {
    std::optional<ClassId> class_id;
    if (segments[s].row >= 0) class_id = frame.segments[static_cast<std::size_t>(segments[s].row)].class_id;
    std::vector<NearCandidate> near;
    for (const BundleCell& cell : segments[s].cells) {
      FindNear(candidates, cell.block, class_id, map.info().config.voxel_size_m, near);
      CountHits(segments[s], cell, near, frame.T_map_sensor.translation(), table.hits[s]);
    }
  });
  table.candidate_hits.assign(candidates.size(), 0);
  for (const auto& row : table.hits) {
    for (std::size_t c = 0; c < row.size(); ++c) table.candidate_hits[c] += row[c];
  }
  return table;
}

}  // namespace dhpmap

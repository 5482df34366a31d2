// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/point_lookup.h"

#include <array>
#include <utility>

#include "mapping/base/grid_reach.h"
#include "mapping/query/voxel_sampler.h"
#include "mapping/submap/voxel_answer.h"

namespace dhpmap {

namespace {

/// One submap's answer at the point.
struct Vote {
  const Submap* submap = nullptr;
  VoxelSample voxel;
  VoxelSupport support;
};

/// Farther than the truncation a distance says only that: it is what older versions carved, but for rounding.
bool IsNearSurface(const Submap& submap, const VoxelSample& voxel) {
  return voxel.distance_m() < 0.999 * submap.info().truncation_m;
}

/// The answers of the submaps around a point.
class Votes {
 public:
  /// Adds a voxel of a submap at the point, observed or not. Prefetches it; Count reads it later.
  void Add(const Submap& submap, const BlockEntry& block, int linear) {
    if (num_fetched_ == kMost) Count();
    __builtin_prefetch(&block.tsdf->weight[static_cast<std::size_t>(linear)]);
    fetched_[num_fetched_++] = {&submap, &block, linear};
  }
  /// Evaluates the voxels added since the last call.
  void Count() {
    for (std::size_t i = 0; i < num_fetched_; ++i) CountOne(fetched_[i]);
    num_fetched_ = 0;
  }

  [[nodiscard]] const Vote& best() const { return best_; }
  [[nodiscard]] float total_support() const { return total_support_; }
  [[nodiscard]] bool is_near_surface() const { return is_near_surface_; }

 private:
  struct Fetched {
    const Submap* submap;
    const BlockEntry* block;
    int linear;
  };
  static constexpr std::size_t kMost = 16;

  void CountOne(const Fetched& fetched) {
    const Submap& submap = *fetched.submap;
    const VoxelSample voxel = SampleVoxel(*fetched.block, fetched.linear);
    if (!voxel.IsObserved()) return;
    is_near_surface_ = is_near_surface_ || IsNearSurface(submap, voxel);
    const VoxelSupport support = SupportOfVoxel(submap, *voxel.block, voxel.linear);
    total_support_ += support.observations;
    if (best_.submap == nullptr || support > best_.support) best_ = {&submap, voxel, support};
  }

  Vote best_;
  float total_support_ = 0;
  bool is_near_surface_ = false;
  std::array<Fetched, kMost> fetched_;
  std::size_t num_fetched_ = 0;
};

bool IsPointLookedThrough(const MapSnapshot& map, const Eigen::Vector3d& p_map) {
  const double voxel_size_m = map.info().config.voxel_size_m;
  const bool is_on_grid = (p_map.array().abs() <= GridReach_m(voxel_size_m)).all();
  return is_on_grid && map.free_space()->IsFree(VoxelAt(p_map, voxel_size_m));
}

}  // namespace

PointLookup::PointLookup(std::shared_ptr<const MapSnapshot> snapshot)
    : snapshot_(std::move(snapshot)), index_(std::make_shared<const SubmapIndex>(snapshot_->submaps())) {}

PointLookup::PointLookup(std::shared_ptr<const MapSnapshot> snapshot, IndexTrail& trail)
    : snapshot_(std::move(snapshot)), index_(trail.Of(*snapshot_)) {}

PointInfo PointLookup::At(const Eigen::Vector3d& p_map) const {
  Votes votes;
  index_->VisitAround(p_map, [&](const SubmapIndex::Entry& entry) {
    const Submap& submap = entry.submap();
    const VoxelIndex voxel = VoxelAt(entry.ToSubmap(p_map), submap.info().voxel_size_m);
    const BlockEntry* block = submap.blocks().Find(BlockOf(voxel));
    if (block != nullptr && block->tsdf != nullptr) votes.Add(submap, *block, LinearIndex(voxel));
  });
  votes.Count();
  const Vote& best = votes.best();
  PointInfo info;
  info.is_free = !votes.is_near_surface() && IsPointLookedThrough(*snapshot_, p_map);
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
  if (votes.total_support() > 0) info.instance_confidence = best.support.observations / votes.total_support();
  return info;
}

}  // namespace dhpmap

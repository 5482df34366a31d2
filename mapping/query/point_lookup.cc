// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/point_lookup.h"

#include <algorithm>
#include <utility>

#include "mapping/map/voxel_answer.h"

namespace dhpmap {

/// Bounding spheres side by side, so that a point is tested against all of them in a few vector instructions each.
struct PointLookup::Index {
  struct Entry {
    const Submap* submap;
    Transform T_submap_map;
    bool is_on_map_axes;  ///< identity pose: no need to transform
  };
  std::vector<float> x, y, z, radius2;
  std::vector<Entry> entries;
};

namespace {

/// One submap's answer at the point.
struct Vote {
  const Submap* submap = nullptr;
  const BlockEntry* block = nullptr;
  int linear = 0;
  VoxelSupport support;
};

}  // namespace

PointLookup::PointLookup(std::shared_ptr<const MapSnapshot> snapshot) : snapshot_(std::move(snapshot)) {
  auto index = std::make_unique<Index>();
  for (const auto& submap : snapshot_->submaps()) {
    const BoundingSphere sphere = submap->BoundingSphereInMap();
    if (sphere.IsEmpty()) continue;
    // Rounded outwards: single precision must not lose a voxel at the rim.
    const double radius_m = sphere.radius_m * (1 + 1e-6) + 1e-6 * sphere.center_m.norm() + 1e-6;
    index->x.push_back(static_cast<float>(sphere.center_m.x()));
    index->y.push_back(static_cast<float>(sphere.center_m.y()));
    index->z.push_back(static_cast<float>(sphere.center_m.z()));
    index->radius2.push_back(static_cast<float>(radius_m * radius_m));
    index->entries.push_back(
        {submap.get(), submap->info().T_map_submap.inverse(), IsIdentity(submap->info().T_map_submap)});
  }
  index_ = std::move(index);
}

PointLookup::~PointLookup() = default;
PointLookup::PointLookup(PointLookup&&) noexcept = default;
PointLookup& PointLookup::operator=(PointLookup&&) noexcept = default;

PointInfo PointLookup::At(const Eigen::Vector3d& p_map) const {
  const Eigen::Vector3f p = p_map.cast<float>();
  Vote best;
  float total_support = 0;
  for (std::size_t i = 0; i < index_->entries.size(); ++i) {
    const float dx = p.x() - index_->x[i], dy = p.y() - index_->y[i], dz = p.z() - index_->z[i];
    if (dx * dx + dy * dy + dz * dz > index_->radius2[i]) continue;
    const Index::Entry& entry = index_->entries[i];
    const Eigen::Vector3d p_submap = entry.is_on_map_axes ? p_map : Eigen::Vector3d(entry.T_submap_map * p_map);
    const VoxelIndex voxel = VoxelAt(p_submap, entry.submap->info().voxel_size_m);
    const BlockEntry* block = entry.submap->blocks().Find(BlockOf(voxel));
    if (block == nullptr || block->tsdf == nullptr) continue;
    const int linear = LinearIndex(voxel);
    if (!block->tsdf->IsObserved(linear)) continue;

    const VoxelSupport support = SupportOfVoxel(*entry.submap, *block, linear);
    total_support += support.observations;
    if (best.submap == nullptr || support > best.support) best = {entry.submap, block, linear, support};
  }
  PointInfo info;
  if (best.submap == nullptr) return info;

  const SubmapInfo& submap = best.submap->info();
  const auto linear = static_cast<std::size_t>(best.linear);
  info.is_observed = true;
  info.submap = submap.id;
  info.panoptic = submap.panoptic;
  info.distance_m = best.block->tsdf->distance_m[linear];
  info.weight = best.block->tsdf->weight[linear];
  info.color = best.block->tsdf->color[linear];
  info.class_id = submap.class_id;
  if (submap.panoptic == Panoptic::kUnknown) return info;
  const BestLabel seen = ClassOfVoxel(*best.submap, *best.block, best.linear);
  const bool is_labelled = best.block->labels != nullptr && !best.block->labels->IsEmpty(best.linear);
  info.class_confidence = is_labelled && !submap.class_is_fixed ? seen.share : submap.ClassConfidence();
  info.instance_confidence = submap.instance_confidence;
  if (total_support > 0) info.instance_confidence = best.support.observations / total_support;
  return info;
}

}  // namespace dhpmap

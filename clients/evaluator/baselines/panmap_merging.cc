// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/baselines/panmap_merging.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mapping/mesh/mesh.h"

namespace dhpmap::evaluator {
namespace {

struct Place {
  float distance_m;
  float weight;
};

/// Trilinear between voxel centres; empty unless all eight are observed.
std::optional<Place> Interpolate(const Submap& submap, const Eigen::Vector3d& p_m) {
  const Eigen::Vector3d p_vox = p_m / submap.info().voxel_size_m - Eigen::Vector3d::Constant(0.5);
  const VoxelIndex base = VoxelAt(p_vox, 1.0);
  const Eigen::Vector3f f = (p_vox - Eigen::Vector3d(base.x, base.y, base.z)).cast<float>();
  Place place{0, 0};
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2 & 1;
    const VoxelIndex voxel{base.x + dx, base.y + dy, base.z + dz};
    const BlockEntry* entry = submap.blocks().Find(BlockOf(voxel));
    const int linear = LinearIndex(voxel);
    if (entry == nullptr || entry->tsdf == nullptr || !entry->tsdf->IsObserved(linear)) return std::nullopt;
    const float share = (dx ? f.x() : 1 - f.x()) * (dy ? f.y() : 1 - f.y()) * (dz ? f.z() : 1 - f.z());
    place.distance_m += share * entry->tsdf->distance_m[static_cast<std::size_t>(linear)];
    place.weight += share * entry->tsdf->weight[static_cast<std::size_t>(linear)];
  }
  return place;
}

std::uint8_t Average(std::uint8_t a, float weight_a, std::uint8_t b, float weight_b) {
  return static_cast<std::uint8_t>(
      (static_cast<float>(a) * weight_a + static_cast<float>(b) * weight_b) / (weight_a + weight_b) + 0.5f);
}

PanmapSubmap* Find(const PanmapSubmaps& submaps, SubmapId id) {
  const auto it =
      std::find_if(submaps.begin(), submaps.end(), [id](const auto& submap) { return submap->geometry.id() == id; });
  return it == submaps.end() ? nullptr : it->get();
}

}  // namespace

SurfaceRelation CompareSurfaces(const PanmapSubmap& a, const PanmapSubmap& b, const PanmapSettings& settings) {
  const Mesh mesh = ExtractMesh(a.OwnGeometry(), LabelSet(), MeshColoring::kSensor);
  if (mesh.vertices_m.empty()) return SurfaceRelation::kApart;
  const double voxel_size_m = b.geometry.info().voxel_size_m;
  const double max_error_m = settings.max_error_vox * voxel_size_m;
  const auto share_of_full = [&settings](float weight) { return std::min(weight / settings.full_weight, 1.0); };
  double total = 0, conflict = 0, match = 0;
  for (const Eigen::Vector3f& vertex : mesh.vertices_m) {
    const Eigen::Vector3d p_m = vertex.cast<double>();
    const std::optional<Place> in_b = Interpolate(b.geometry, p_m);
    const std::optional<Place> in_a = Interpolate(a.geometry, p_m);
    if (!in_a || !in_b) continue;
    const double weight = std::sqrt(share_of_full(in_a->weight) * share_of_full(in_b->weight));
    total += weight;
    // Voxels foreign to b give no information on b's surface.
    if (!b.Belongs(VoxelAt(p_m, voxel_size_m))) continue;
    if (in_b->distance_m < -max_error_m) conflict += weight;
    else if (in_b->distance_m <= max_error_m) match += weight;
  }
  const double least_share = settings.min_points / static_cast<double>(mesh.vertices_m.size());
  if (conflict > std::max(settings.max_conflict, least_share) * total) return SurfaceRelation::kConflict;
  return match > std::max(settings.min_match, least_share) * total ? SurfaceRelation::kMatch : SurfaceRelation::kApart;
}

void MergeInto(const PanmapSubmap& from, const MapConfig& config, PanmapSubmap& into) {
  const auto max_weight = static_cast<float>(config.integration.max_weight);
  for (const BlockEntry& entry : from.geometry.blocks().entries()) {
    if (entry.tsdf == nullptr) continue;
    const TsdfBlock& b = *entry.tsdf;
    TsdfBlock& a = into.geometry.MutableTsdf(entry.index);
    for (std::size_t i = 0; i < kBlockVoxels; ++i) {
      if (b.weight[i] < kMinObservedWeight) continue;
      const float sum = a.weight[i] + b.weight[i];
      a.distance_m[i] = (a.distance_m[i] * a.weight[i] + b.distance_m[i] * b.weight[i]) / sum;
      a.color[i] = {Average(a.color[i].r, a.weight[i], b.color[i].r, b.weight[i]),
                    Average(a.color[i].g, a.weight[i], b.color[i].g, b.weight[i]),
                    Average(a.color[i].b, a.weight[i], b.color[i].b, b.weight[i])};
      a.weight[i] = std::min(sum, max_weight);
    }
  }
  for (const auto& [index, block] : from.belonging) {
    BelongingBlock& counts = into.belonging[index];
    for (std::size_t i = 0; i < kBlockVoxels; ++i) counts.Add(i, block);
  }
  into.geometry.mutable_info().num_frames_observed += from.geometry.info().num_frames_observed;
  into.geometry.UpdateBoundingSphere();
}

bool MergeWithInactive(SubmapId id, const MapConfig& config, const PanmapSettings& settings, PanmapSubmaps& submaps) {
  bool has_merged = false;
  for (std::size_t i = 0; i < submaps.size();) {
    PanmapSubmap* submap = Find(submaps, id);
    PanmapSubmap* other = submaps[i++].get();
    const SubmapInfo& info = submap->geometry.info();
    if (other == submap || other->IsActive() || other->geometry.info().class_id != info.class_id) continue;
    if (!other->geometry.bounding_sphere().Intersects(submap->geometry.bounding_sphere())) continue;
    if (CompareSurfaces(*submap, *other, settings) != SurfaceRelation::kMatch) continue;
    PanmapSubmap& stays = info.id < other->geometry.id() ? *submap : *other;
    const PanmapSubmap& goes = &stays == submap ? *other : *submap;
    MergeInto(goes, config, stays);
    id = stays.geometry.id();
    std::erase_if(submaps, [&goes](const auto& s) { return s.get() == &goes; });
    has_merged = true;
    i = 0;  // the merged surface may match others
  }
  return has_merged;
}

}  // namespace dhpmap::evaluator

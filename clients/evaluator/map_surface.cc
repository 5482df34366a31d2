// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/map_surface.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace dhpmap::evaluator {
namespace {

struct Label {
  std::uint16_t class_id = 0;
  std::uint32_t instance = 0;
};

Label LabelOf(const Submap& submap) {
  if (submap.info().panoptic == Panoptic::kUnknown) return {};
  return {submap.info().class_id.value, submap.id().value};
}

/// The submaps on the map's grid as one, with who holds which voxel.
class WholeField {
 public:
  explicit WholeField(double voxel_size_m) : whole_(InfoOf(voxel_size_m), 1) {}

  /// Voxels that were taken before stay.
  void Take(const Submap& submap) {
    for (const BlockEntry& entry : submap.blocks().entries()) {
      if (entry.tsdf == nullptr || !entry.tsdf->HasObservedVoxel()) continue;
      TsdfBlock& tsdf = whole_.MutableTsdf(entry.index);
      auto& holders = holders_[entry.index];
      for (int i = 0; i < kBlockVoxels; ++i) {
        if (!entry.tsdf->IsObserved(i) || tsdf.IsObserved(i)) continue;
        tsdf.distance_m[i] = entry.tsdf->distance_m[i];
        tsdf.weight[i] = entry.tsdf->weight[i];
        tsdf.color[i] = entry.tsdf->color[i];
        holders[static_cast<std::size_t>(i)] = &submap;
      }
    }
  }

  [[nodiscard]] Mesh Extract(const LabelSet& label_set) const {
    const Mesh mesh = ExtractMesh(whole_, label_set, MeshColoring::kSensor);
    Mesh labelled;
    for (const auto& triangle : mesh.triangles) {
      Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
      for (const std::uint32_t v : triangle) centre_m += mesh.vertices_m[v].cast<double>() / 3;
      const Label label = LabelAt(centre_m);
      const auto first = static_cast<std::uint32_t>(labelled.vertices_m.size());
      labelled.triangles.push_back({first, first + 1, first + 2});
      for (const std::uint32_t v : triangle) {
        labelled.vertices_m.push_back(mesh.vertices_m[v]);
        labelled.normals.push_back(mesh.normals[v]);
        labelled.colors.push_back(mesh.colors[v]);
        labelled.classes.push_back(label.class_id);
        labelled.instances.push_back(label.instance);
      }
    }
    return labelled;
  }

 private:
  static SubmapInfo InfoOf(double voxel_size_m) {
    SubmapInfo info;
    info.voxel_size_m = voxel_size_m;
    return info;
  }

  /// That of the holder of most corners of the cell; of equals, of the nearest.
  [[nodiscard]] Label LabelAt(const Eigen::Vector3d& p_m) const {
    const double voxel_size_m = whole_.info().voxel_size_m;
    const VoxelIndex low = VoxelAt(p_m - Eigen::Vector3d::Constant(0.5 * voxel_size_m), voxel_size_m);
    struct Votes {
      Label label;
      int count = 0;
      double nearest_m = 0;
    };
    std::array<Votes, 8> votes;
    int num_labels = 0;
    for (int c = 0; c < 8; ++c) {
      const VoxelIndex corner{low.x + (c & 1), low.y + (c >> 1 & 1), low.z + (c >> 2 & 1)};
      const Label label = HeldAt(corner);
      if (label.instance == 0) continue;
      const double distance_m = (VoxelCentre(corner, voxel_size_m) - p_m).norm();
      auto* const end = votes.begin() + num_labels;
      auto* const same =
          std::find_if(votes.begin(), end, [&](const Votes& v) { return v.label.instance == label.instance; });
      if (same == end) votes[static_cast<std::size_t>(num_labels++)] = {label, 1, distance_m};
      else *same = {label, same->count + 1, std::min(same->nearest_m, distance_m)};
    }
    const auto* const best =
        std::max_element(votes.begin(), votes.begin() + num_labels, [](const Votes& a, const Votes& b) {
          return a.count != b.count ? a.count < b.count : a.nearest_m > b.nearest_m;
        });
    return num_labels == 0 ? Label{} : best->label;
  }

  [[nodiscard]] Label HeldAt(VoxelIndex v) const {
    const auto block = holders_.find(BlockOf(v));
    if (block == holders_.end()) return {};
    const Submap* holder = block->second[static_cast<std::size_t>(LinearIndex(v))];
    return holder == nullptr ? Label{} : LabelOf(*holder);
  }

  Submap whole_;
  std::unordered_map<BlockIndex, std::array<const Submap*, kBlockVoxels>, BlockIndexHash> holders_;
};

void AddAlone(const Submap& submap, const LabelSet& label_set, Mesh& mesh) {
  Mesh part = ExtractMesh(submap, label_set, MeshColoring::kSensor);
  const Label label = LabelOf(submap);
  std::fill(part.classes.begin(), part.classes.end(), label.class_id);
  std::fill(part.instances.begin(), part.instances.end(), label.instance);
  AppendMesh(part, mesh);
}

}  // namespace

LabelledSurface SurfaceOf(const Map& map) {
  const MapConfig& config = map.info().config;
  const LabelSet& label_set = *map.info().label_set;
  LabelledSurface surface;
  WholeField whole(config.voxel_size_m);
  const Submap* unknown = nullptr;  // last: it only has what nobody else holds
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    const bool on_map_grid = IsIdentity(info.T_map_submap) && info.voxel_size_m == config.voxel_size_m;
    if (!config.refinement.management || !on_map_grid) AddAlone(*submap, label_set, surface.mesh);
    else if (submap->id() == kUnknownSubmap) unknown = submap.get();
    else whole.Take(*submap);
    if (info.panoptic == Panoptic::kUnknown) continue;
    surface.instance_scores[submap->id().value] = info.ClassConfidence() * info.instance_confidence;
  }
  if (unknown != nullptr) whole.Take(*unknown);
  if (config.refinement.management) AppendMesh(whole.Extract(label_set), surface.mesh);
  return surface;
}

}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/map_surface.h"

#include <algorithm>
#include <array>

#include "mapping/map/map_grid.h"
#include "mapping/mesh/marching_cubes.h"
#include "mapping/mesh/surface_field.h"

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

/// Labels of the cells of a field.
class CellLabels {
 public:
  explicit CellLabels(const SurfaceField& field) : field_(field) {}

  /// At a point on the surface: that of the submap that answers for most corners of its cell; of equals, of the
  /// nearest.
  [[nodiscard]] Label At(const Eigen::Vector3d& p_m) const {
    const double voxel_size_m = field_.voxel_size_m();
    const VoxelIndex low = VoxelAt(p_m - Eigen::Vector3d::Constant(0.5 * voxel_size_m), voxel_size_m);
    std::array<Votes, 8> votes;
    auto* end = votes.begin();
    for (int c = 0; c < 8; ++c) {
      const VoxelIndex corner{low.x + (c & 1), low.y + (c >> 1 & 1), low.z + (c >> 2 & 1)};
      const Label label = LabelAt(corner);
      if (label.instance == 0) continue;
      const double distance_m = (VoxelCentre(corner, voxel_size_m) - p_m).norm();
      auto* const same =
          std::find_if(votes.begin(), end, [&](const Votes& v) { return v.label.instance == label.instance; });
      if (same == end) *end++ = {label, 1, distance_m};
      else *same = {label, same->count + 1, std::min(same->nearest_m, distance_m)};
    }
    if (end == votes.begin()) return {};
    return std::max_element(votes.begin(), end,
                            [](const Votes& a, const Votes& b) {
                              return a.count != b.count ? a.count < b.count : a.nearest_m > b.nearest_m;
                            })
        ->label;
  }

 private:
  struct Votes {
    Label label;
    int count = 0;
    double nearest_m = 0;
  };

  [[nodiscard]] Label LabelAt(VoxelIndex v) const {
    const BlockEntry* entry = field_.blocks().Find(BlockOf(v));
    if (entry == nullptr || !entry->tsdf->IsObserved(LinearIndex(v))) return {};
    const auto block = static_cast<std::size_t>(entry - field_.blocks().entries().data());
    return LabelOf(*field_.HolderAt(block, LinearIndex(v)).submap);
  }

  const SurfaceField& field_;
};

/// The same triangles with corners of their own, each triangle with the label of its cell.
Mesh LabelledByCell(const Mesh& mesh, const CellLabels& cells) {
  Mesh labelled;
  for (const auto& triangle : mesh.triangles) {
    Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
    for (const std::uint32_t v : triangle) centre_m += mesh.vertices_m[v].cast<double>() / 3;
    const Label label = cells.At(centre_m);
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

void AddAlone(const Submap& submap, const LabelSet& label_set, Mesh& mesh) {
  Mesh part = ExtractMesh(submap, label_set, MeshColoring::kSensor);
  const Label label = LabelOf(submap);
  std::fill(part.classes.begin(), part.classes.end(), label.class_id);
  std::fill(part.instances.begin(), part.instances.end(), label.instance);
  AppendMesh(part, mesh);
}

Mesh AsOneField(const std::vector<const Submap*>& submaps, const LabelSet& label_set) {
  if (submaps.empty()) return {};
  ThreadPool here(1);
  const SurfaceField field(submaps, here);
  return LabelledByCell(MarchCubes(field, label_set, MeshColoring::kSensor, here), CellLabels(field));
}

}  // namespace

LabelledSurface SurfaceOf(const Map& map, SurfaceKind kind) {
  const LabelSet& label_set = *map.info().label_set;
  LabelledSurface surface;
  std::vector<const Submap*> as_one;
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    if (info.panoptic != Panoptic::kUnknown) {
      surface.instance_scores[info.id.value] = info.ClassConfidence() * info.instance_confidence;
    }
    if (kind == SurfaceKind::kOneField && IsOnMapGrid(info, map.info().config)) as_one.push_back(submap.get());
    else AddAlone(*submap, label_set, surface.mesh);
  }
  AppendMesh(AsOneField(as_one, label_set), surface.mesh);
  return surface;
}

}  // namespace dhpmap::evaluator

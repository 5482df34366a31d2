// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/map_surface.h"

#include "mapping/mesh/map_mesh.h"

namespace dhpmap::evaluator {
namespace {

Mesh EachSubmap(const Map& map) {
  Mesh mesh;
  for (const auto& submap : map.submaps()) {
    AppendMesh(ExtractMesh(*submap, *map.info().label_set, MeshColoring::kSensor), mesh);
  }
  return mesh;
}

Mesh OneField(const Map& map) {
  ThreadPool here(1);
  return ExtractMapMesh(MapSnapshot(map.info(), map.submaps()), MeshColoring::kSensor, here);
}

}  // namespace

LabelledSurface SurfaceOf(const Map& map, SurfaceKind kind) {
  LabelledSurface surface;
  surface.mesh = kind == SurfaceKind::kOneField ? OneField(map) : EachSubmap(map);
  for (std::size_t i = 0; i < surface.mesh.instances.size(); ++i) {
    const SubmapInfo& info = map.Find(SubmapId(surface.mesh.instances[i]))->info();
    surface.mesh.classes[i] = info.panoptic == Panoptic::kUnknown ? 0 : info.class_id.value;
  }
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    if (info.panoptic == Panoptic::kUnknown) continue;
    surface.instance_scores[info.id.value] = info.ClassConfidence() * info.instance_confidence;
  }
  return surface;
}

}  // namespace dhpmap::evaluator

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/map_mesh.h"

#include "mapping/map/map_grid.h"
#include "mapping/mesh/marching_cubes.h"

namespace dhpmap {

Mesh ExtractMapMesh(const MapSnapshot& map, MeshColoring coloring, ThreadPool& pool) {
  const LabelSet& label_set = *map.info().label_set;
  std::vector<const Submap*> on_grid, others;
  for (const auto& submap : map.submaps()) {
    if (submap->IsAbsent()) continue;
    (IsExclusive(submap->info(), map.info().config) ? on_grid : others).push_back(submap.get());
  }
  Mesh mesh;
  if (!on_grid.empty()) mesh = MarchCubes(SurfaceField(on_grid, pool), label_set, coloring, pool);
  for (const Submap* const& submap : others) {
    AppendMesh(MarchCubes(SurfaceField({&submap, 1}, pool), label_set, coloring, pool), mesh);
  }
  return mesh;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/mesh/marching_cubes.h"

#include "mapping/mesh/surface_extractor.h"

namespace dhpmap {

Mesh MarchCubes(const SurfaceField& field, const LabelSet& label_set, MeshColoring coloring, ThreadPool& pool) {
  const SurfaceExtractor surface(field, label_set, coloring, pool);
  Mesh mesh;
  ResizeVertices(surface.FirstVertex(surface.num_blocks()), mesh);
  mesh.triangles.resize(surface.FirstTriangle(surface.num_blocks()));
  pool.ParallelFor(surface.num_blocks(), [&](std::size_t block) { surface.MakeVertices(block, 0, mesh); });
  pool.ParallelFor(surface.num_blocks(), [&](std::size_t block) { surface.MakeTriangles(block, 0, mesh); });
  return mesh;
}

Mesh ExtractMesh(const Submap& submap, const LabelSet& label_set, MeshColoring coloring) {
  ThreadPool here(1);
  const Submap* const submaps[] = {&submap};
  return MarchCubes(SurfaceField(submaps, here), label_set, coloring, here);
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/thread_pool.h"
#include "mapping/mesh/mesh.h"
#include "mapping/mesh/surface_field.h"

namespace dhpmap {

/// Marching cubes over all cells of the field whose 8 corners are observed (Lorensen and Cline 1987). Vertices and
/// triangles by ascending block, then voxel; does not depend on the number of threads.
Mesh MarchCubes(const SurfaceField& field, const LabelSet& label_set, MeshColoring coloring, ThreadPool& pool);

}  // namespace dhpmap

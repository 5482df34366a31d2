// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/thread_pool.h"
#include "mapping/mesh/mesh.h"

namespace dhpmap {

/// The surface of a whole map. All submaps that were seen on the map's grid, the unknown one too, are meshed as one
/// field (see SurfaceField): cells whose corners are different submaps' are meshed like any other, so there are no gaps
/// between submaps once label management has made positions exclusive, and no doubled surfaces before. Submaps on grids
/// of their own (moved objects, other voxel sizes) follow, each by itself. Deterministic order, whatever the number of
/// threads.
Mesh ExtractMapMesh(const MapSnapshot& map, MeshColoring coloring, ThreadPool& pool);

}  // namespace dhpmap

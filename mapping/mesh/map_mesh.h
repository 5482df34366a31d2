// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/thread_pool.h"
#include "mapping/mesh/mesh.h"

namespace dhpmap {

/// The surface of a whole map. All submaps on the map's grid, including the unknown one, are meshed as one field (see
/// SurfaceField), also across cells with corners in different submaps. So there are no gaps between submaps once label
/// management has made positions exclusive, and no doubled surfaces before. Submaps on their own grids (moved objects,
/// other voxel sizes) follow separately. Deterministic order for any number of threads.
Mesh ExtractMapMesh(const MapSnapshot& map, MeshColoring coloring, ThreadPool& pool);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// Whether the submap shows at least so many voxels within half a voxel of its surface. Quick for what has many.
bool HasSurfaceVoxels(const Submap& submap, std::int64_t least);

/// Whether the surfaces of two submaps on the same grid overlap or touch: some voxel within half a voxel of the one is
/// also of the other, or beside one of it (26 neighbours).
bool SurfacesTouch(const Submap& a, const Submap& b);

}  // namespace dhpmap

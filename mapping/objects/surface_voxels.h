// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/submap/submap.h"

namespace dhpmap {

/// Whether the submap shows at least `least` voxels within half a voxel of its surface. Quick for submaps with many.
bool HasSurfaceVoxels(const Submap& submap, std::int64_t least);

/// Whether the surfaces of two submaps on the same grid overlap or touch: a voxel within half a voxel of one surface is
/// equal to such a voxel of the other, or one of its 26 neighbours.
bool SurfacesTouch(const Submap& a, const Submap& b);

}  // namespace dhpmap

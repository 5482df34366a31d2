// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/map/map.h"

namespace dhpmap {

/// Splits inactive, confirmed things with separate parts: a wrong match, or a mask over both, may have joined two
/// objects. Parts are separate if cells of `cell_vox` voxels that hold some of them do not touch, corners included.
/// With twice the gap of SplitIntoParts, no single part of a segment can have shown both, unless other submaps took the
/// voxels in between since. Each part with at least `least_surface_voxels` voxels within half a voxel of its surface,
/// up to kMostApartParts, becomes a thing; the largest keeps the id, and smaller parts stay with it. No observation is
/// lost (SplitSubmap).
///
/// Later frames may show that they are one object after all: the pairs start with the minimum evidence (kLeastEvidence)
/// and no verdict. Edited, locked, merged and absent things do not change, nor do things in view, off the map's grid,
/// or with persistent ids, which are more reliable. Verdicts against merging the whole apply to the parts. Returns how
/// many things were created. Linear in the blocks of such things; independent of the order of blocks in memory.
int SplitApartThings(int cell_vox, std::int64_t least_surface_voxels, Map& map);

inline constexpr int kMostApartParts = 8;

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/map/map.h"

namespace dhpmap {

/// Makes several things of settled, confirmed ones whose voxels lie apart: two that a wrong match, or a mask over both,
/// once put into one. Parts are apart where cells of `cell_vox` voxels that hold some of them do not touch, corners
/// included. With twice the gap at which segments are cut (SplitIntoParts) no part of a segment can have shown two of
/// them, but for what lay between and has been given to others since. Each part with at least `least_surface_voxels`
/// voxels within half a voxel of its surface, up to kMostApartParts, becomes a thing; the largest keeps the id, and
/// smaller parts stay with it. Nothing observed is lost (SplitSubmap).
///
/// Frames may tell later that they are one all the same: the pairs begin with what frames that show them apart say
/// most (kLeastEvidence), and no verdict. What somebody has edited or locked stays as it is, as does what was merged,
/// by whomever, and what is absent, in view, off the map's grid, or known by persistent ids, which are truer. Whom the
/// whole must not be merged with the parts must not, either. Returns how many things it made. Time is linear in the
/// blocks of such things; the outcome does not depend on the order of blocks in memory.
int SplitApartThings(int cell_vox, std::int64_t least_surface_voxels, Map& map);

inline constexpr int kMostApartParts = 8;

}  // namespace dhpmap

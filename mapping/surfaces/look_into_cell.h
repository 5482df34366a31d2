// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/surfaces/nearby_cells.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

CellSight LookIntoCell(const MapSurfaces& surfaces, BlockIndex block);

/// All things whose inside may overlap a block of the map's grid.
std::vector<UnseenInside::Thing> ThingsAround(const MapSurfaces& surfaces, BlockIndex block);

/// Both parts; valid as long as `surfaces`.
StateLook LookOf(const MapSurfaces& surfaces);

}  // namespace dhpmap

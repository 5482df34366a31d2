// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/surfaces/nearby_cells.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

CellSight LookIntoCell(const MapSurfaces& surfaces, BlockIndex block);

/// All things of which some of a block of the map's grid may be the inside.
std::vector<UnseenInside::Thing> ThingsAround(const MapSurfaces& surfaces, BlockIndex block);

/// Both, for as long as `surfaces` are there.
StateLook LookOf(const MapSurfaces& surfaces);

}  // namespace dhpmap

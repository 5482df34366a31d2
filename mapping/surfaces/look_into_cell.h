// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/surfaces/cell_sight.h"
#include "mapping/surfaces/look_into_cell.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap {

CellSight LookIntoCell(const MapSurfaces& surfaces, BlockIndex block);

}  // namespace dhpmap

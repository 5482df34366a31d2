// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/refinement_scratch.h"
#include "mapping/map/map_config.h"
#include "mapping/refinement/tile_problem.h"

namespace dhpmap {

/// How likely each instance is at each of a tile's voxels, the rim's included, after the CRF: by member, then channel;
/// those of a member add up to 1. From what was seen alone, whatever was concluded before.
ScratchVector<float> TileMarginals(const TileProblem& problem, const MapConfig& map_config);

}  // namespace dhpmap

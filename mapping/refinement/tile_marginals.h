// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/refinement_scratch.h"
#include "mapping/map/map_config.h"
#include "mapping/refinement/tile_problem.h"

namespace dhpmap {

/// The marginals of each instance at each voxel of a tile, including the rim, after the CRF: by member, then channel.
/// The marginals of a member add up to 1. Computed from observations only, not from earlier conclusions.
ScratchVector<float> TileMarginals(const TileProblem& problem, const MapConfig& map_config);

}  // namespace dhpmap

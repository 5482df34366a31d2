// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <random>

#include "mapping/map/map.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap::bench {

/// Prints what edits cost that change nothing where is asked: a thing is renamed, and one moves far from all that is
/// asked about; how long the next state and the first 10,000 distances in it take.
void MeasureQuietEdits(const std::shared_ptr<const MapSnapshot>& map, SurfaceCache& cache, std::mt19937& random);

}  // namespace dhpmap::bench

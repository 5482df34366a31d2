// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "mapping/surfaces/surface_cache.h"

namespace dhpmap::bench {

/// Prints how fast bodies and motions are checked on one core, from places that were looked through.
void MeasureChecks(const std::shared_ptr<const MapSurfaces>& surfaces);

}  // namespace dhpmap::bench

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <random>

#include "mapping/map/map.h"

namespace dhpmap::bench {

/// Prints what the first 10,000 distances cost of a map that nobody has asked about, in the box of its things and in a
/// cube of 4 m about one of them, exact and with a tolerance; how many passes of 10,000 others, and how much of a core,
/// it takes until they come as fast as they ever will, and what is kept for it then.
void MeasureFirstDistances(const std::shared_ptr<const MapSnapshot>& map, std::mt19937& random);

}  // namespace dhpmap::bench

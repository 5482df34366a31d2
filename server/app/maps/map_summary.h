// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "mapping/base/status.h"
#include "mapping/map/map.h"

namespace dhpmap {

struct MapSummary {
  MapInfo info;
  std::int64_t num_submaps = 0;  ///< the unknown submap included
  Status damage;                 ///< why the store cannot read the map; then only info.name is valid
};

MapSummary SummaryOf(const MapSnapshot& snapshot);

}  // namespace dhpmap

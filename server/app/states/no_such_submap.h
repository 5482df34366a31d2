// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

/// NOT_FOUND, with reason MERGED_INTO and the successor's name if the submap was merged.
Status NoSuchSubmap(const MapInfo& map, SubmapId id);

}  // namespace dhpmap

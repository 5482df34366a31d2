// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

/// NOT_FOUND, with reason MERGED_INTO and the other's name if the submap is a part of another now.
Status NoSuchSubmap(const MapInfo& map, SubmapId id);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/map/map.h"

namespace dhpmap {

/// Whether these are of one published state. The revision alone does not tell: a state that was refused and dropped
/// leaves its revision to the next one, which was published at another time.
bool IsSameState(const MapInfo& a, const MapInfo& b);

}  // namespace dhpmap

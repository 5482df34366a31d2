// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/ids.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// The background submap that frames mean by a class; null: none. Where it was seen: what somebody has moved or copied
/// is not what is seen there now. What was made for the class comes first, then what was seen as it before somebody
/// gave it another, then what somebody has given this one.
const Submap* FindStuff(const Map& map, ClassId class_id);

}  // namespace dhpmap

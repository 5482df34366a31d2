// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mapping/base/ids.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// The background submap to which a segment of this class belongs; null: none. Only a submap at the place where it was
/// observed, not one that an edit has moved or cloned. Prefers the submap that was created for the class, then one that
/// was observed as this class before an edit relabelled it, then one that an edit relabelled to this class.
const Submap* FindStuff(const Map& map, ClassId class_id);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "mapping/map/display_name.h"
#include "mapping/map/map.h"

namespace dhpmap {

/// What to change of a map; what is empty stays.
struct MapPatch {
  std::optional<std::string> display_name;
};

/// All of it or nothing: INVALID_ARGUMENT for a display name above kMaxDisplayNameBytes, ABORTED for an etag (where not
/// empty) that is not the present one.
Status PatchMap(Map& map, const std::string& etag, const MapPatch& patch);

}  // namespace dhpmap

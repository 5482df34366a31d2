// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mapping/map/map.h"
#include "mapping/submap/display_name.h"
#include "storage/store.h"

namespace dhpmap {

/// Changes of a map; empty values stay.
struct MapPatch {
  std::optional<std::string> display_name;
};

/// ABORTED, reason EDITED_SINCE, if the log has an edit of the map itself (of its name), or an undo or redo of one,
/// after the revision; 0: no condition.
Status CheckMapNotEditedSince(std::int64_t revision, MapStore& store, const std::string& map);

/// All or nothing: INVALID_ARGUMENT for a display name above kMaxDisplayNameBytes, ABORTED for a non-empty etag other
/// than the present one.
Status PatchMap(Map& map, const std::string& etag, const MapPatch& patch);

}  // namespace dhpmap

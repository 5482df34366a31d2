// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/changes/map_change.h"
#include "mapping/map/edit_entry.h"
#include "server/app/edits/edit_list.h"

namespace dhpmap {

// What the log of a map says of an edit that was made.

/// Of all of a list together: what it made and removed again is in neither.
EditSummary SummaryOfList(const EditList& list, const std::vector<EditResult>& results);

/// The regions that a list has cleared, in its order: what those who follow the map are told.
std::vector<RegionEvent> ClearedBy(const EditList& list, const std::vector<EditResult>& results);

}  // namespace dhpmap

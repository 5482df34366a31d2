// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/changes/map_change.h"
#include "mapping/map/edit_entry.h"
#include "server/app/edits/edit_list.h"

namespace dhpmap {

// Entries of the edit log.

/// Of a whole list: objects that it creates and removes again are not listed.
EditSummary SummaryOfList(const EditList& list, const std::vector<EditResult>& results);

/// The regions that a list has cleared, in its order, for watchers.
std::vector<RegionEvent> ClearedBy(const EditList& list, const std::vector<EditResult>& results);

}  // namespace dhpmap

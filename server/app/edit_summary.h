// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/map/edit_entry.h"
#include "server/app/edit_list.h"

namespace dhpmap {

// What the log of a map says of an edit that was made.

EditSummary SummaryOfPatch(SubmapId id, const SubmapPatch& patch);
EditSummary SummaryOfClone(SubmapId original, SubmapId copy);
EditSummary SummaryOfDelete(SubmapId id);
/// Of all of a list together: what it made and removed again is in neither.
EditSummary SummaryOfList(const EditList& list, const std::vector<EditResult>& results);

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/change_filter.h"

namespace dhpmap {

bool ChangeFilter::Passes(const SubmapEvent& event) const {
  if (!submaps.empty() && !submaps.contains(event.info.id)) return false;
  if (!kinds.empty() && !kinds.contains(event.kind)) return false;
  if (event.kind == ChangeKind::kChanged && !parts.empty() && !event.parts.HasAnyOf(parts)) return false;
  if (event.before && place.Passes(*event.before)) return true;
  const bool is_gone = event.kind == ChangeKind::kRemoved || event.kind == ChangeKind::kMerged;
  // What came and went between two states may have been anywhere: who listed it meanwhile must hear that it is gone.
  if (is_gone) return !event.before;
  return place.Passes({event.info.panoptic, event.info.class_id, event.observed});
}

}  // namespace dhpmap

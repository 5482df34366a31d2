// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include "mapping/changes/map_change.h"
#include "server/app/queries/submap_filter.h"

namespace dhpmap {

/// Which events to tell: those that pass every condition given.
struct ChangeFilter {
  std::set<SubmapId> submaps;  ///< one of these; empty: any
  SubmapFilter place;          ///< of the submap before or after; what is gone, before, if it was there
  std::set<ChangeKind> kinds;  ///< one of these; empty: any
  SubmapParts parts;           ///< of kChanged, any of these has changed; empty: any, or none

  [[nodiscard]] bool Passes(const SubmapEvent& event) const;
  /// Of a region only the place counts; a filter that asks for some objects passes none.
  [[nodiscard]] bool Passes(const RegionEvent& event) const;
};

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include "mapping/changes/map_change.h"
#include "server/app/queries/submap_filter.h"

namespace dhpmap {

/// A filter of events: all given conditions must hold.
struct ChangeFilter {
  std::set<SubmapId> submaps;  ///< one of these; empty: any
  SubmapFilter place;          ///< of the submap before or after; for a removed one, before
  std::set<ChangeKind> kinds;  ///< one of these; empty: any
  SubmapParts parts;           ///< of kChanged: one of these has changed; empty: any

  [[nodiscard]] bool Passes(const SubmapEvent& event) const;
  /// Only the place of a region counts; filters by object never match.
  [[nodiscard]] bool Passes(const RegionEvent& event) const;
};

}  // namespace dhpmap

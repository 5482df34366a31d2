// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dhpmap {

/// Revisions from the first to the last.
struct RevisionRange {
  std::int64_t first = 0, last = 0;
  constexpr bool operator==(const RevisionRange&) const = default;
};

/// Revisions of a map's history that may have been seen and were never stored; ascending. There are none in the map's
/// past: what somebody holds of such a state is of no state any more.
using LostRevisions = std::vector<RevisionRange>;

inline bool IsLost(const LostRevisions& lost, std::int64_t revision) {
  const auto next =
      std::upper_bound(lost.begin(), lost.end(), revision,
                       [](std::int64_t wanted, const RevisionRange& range) { return wanted < range.first; });
  return next != lost.begin() && revision <= (next - 1)->last;
}

}  // namespace dhpmap

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace dhpmap {

/// First and last revision, both included.
struct RevisionRange {
  std::int64_t first = 0, last = 0;
  constexpr bool operator==(const RevisionRange&) const = default;
};

/// Ascending ranges of revisions that clients may have seen and that were never stored. References to such a state are
/// invalid for ever.
using LostRevisions = std::vector<RevisionRange>;

inline bool IsLost(const LostRevisions& lost, std::int64_t revision) {
  const auto next =
      std::upper_bound(lost.begin(), lost.end(), revision,
                       [](std::int64_t wanted, const RevisionRange& range) { return wanted < range.first; });
  return next != lost.begin() && revision <= (next - 1)->last;
}

}  // namespace dhpmap
